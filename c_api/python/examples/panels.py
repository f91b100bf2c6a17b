"""A panel method for incompressible potential flow around one section, with its adjoint.

Panels between neighbouring points carry constant vortex sheets. The stream function is constant on the
section, and the speeds of the two panels at the trailing edge are equal (Kutta's condition). The speed on
a panel is the strength of its sheet.
"""
import numpy as np


class Panels:
    """The flow around a section.

    Parameters
    ----------
    points : array of shape (n, 2)
        The closed outline, clockwise, from the trailing edge around; the first point is not repeated.
    alpha : float
        Angle of attack [degrees]; the speed far away is 1.
    """

    def __init__(self, points, alpha):
        self.a, self.b = points, np.roll(points, -1, axis=0)
        self.length = np.hypot(*(self.b - self.a).T)
        self.along = (self.b - self.a) / self.length[:, None]
        self.normal = np.stack([-self.along[:, 1], self.along[:, 0]], axis=1)
        self.flow = np.array([-np.sin(np.radians(alpha)), np.cos(np.radians(alpha))])
        middle = (self.a + self.b) / 2
        offset = middle[:, None] - self.a  # from the beginning of panel j to the middle of panel i
        self.x = (offset * self.along).sum(-1)
        self.z = (offset * self.normal).sum(-1)
        rest = self.x - self.length
        self.log_a = 0.5 * np.log(self.x**2 + self.z**2)
        self.log_b = 0.5 * np.log(rest**2 + self.z**2)
        self.angle = np.arctan2(self.z, rest) - np.arctan2(self.z, self.x)
        np.fill_diagonal(self.angle, 0.0)
        integral = self.x * self.log_a - rest * self.log_b - self.length + self.z * self.angle
        n = len(points)
        self.matrix = np.zeros((n + 1, n + 1))
        self.matrix[:n, :n] = integral / (2 * np.pi)
        self.matrix[:n, n] = -1.0
        self.matrix[n, [0, n - 1]] = 1.0
        self.solution = np.linalg.solve(self.matrix, np.append(-middle @ self.flow, 0.0))
        self.speed = self.solution[:n]

    def lift(self):
        """Return the lift coefficient, for a chord of 1, and its derivatives by speed and length."""
        return 2 * self.speed @ self.length, 2 * self.length, 2 * self.speed

    def unevenness(self):
        """Return the integral of (pressure coefficient)^2, and its derivatives by speed and length."""
        pressure = 1 - self.speed**2
        return pressure**2 @ self.length, -4 * pressure * self.speed * self.length, pressure**2

    def force(self):
        """Return the force of the pressure on each point, shape (n, 2)."""
        panel = ((self.speed**2 - 1) * self.length)[:, None] * self.normal
        return (panel + np.roll(panel, 1, axis=0)) / 2

    def adjoint(self, by_speed, by_length):
        """Return derivatives by the points, shape (n, 2), of a function of speeds and lengths."""
        n = len(self.a)
        dual = np.linalg.solve(self.matrix.T, np.append(by_speed, 0.0))[:n]
        weight = -dual[:, None] * self.speed / (2 * np.pi)
        by_x, by_z = self.log_a - self.log_b, self.angle
        to_middle = by_x[..., None] * self.along + by_z[..., None] * self.normal
        turn = (by_x * self.z - by_z * self.x) / self.length
        to_b = self.log_b[..., None] * self.along + turn[..., None] * self.normal
        middle = (weight[..., None] * to_middle).sum(1) - dual[:, None] * self.flow
        ends = (weight[..., None] * to_b).sum(0)
        starts = -(weight[..., None] * (to_middle + to_b)).sum(0)
        stretch = by_length[:, None] * self.along
        return middle / 2 + starts - stretch + np.roll(middle / 2 + ends + stretch, 1, axis=0)

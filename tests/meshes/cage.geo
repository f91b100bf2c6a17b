// Harmonic coordinates: the inside of a polygonal cage, which is the curve of degree 1 in cage.curve.
size = 0.09;
x[] = {-0.3, 0.3, 0.4, 1.5, 1.5, 0.45, 0.4, -0.4, -0.45, -1.5, -1.5, -0.4};
y[] = {-1.4, -1.4, -0.2, 0.0, 0.5, 0.5, 1.3, 1.3, 0.5, 0.5, 0.0, -0.2};
n = 12;
For i In {0:n-1}
  Point(1 + i) = {x[i], y[i], 0, size};
EndFor
For i In {0:n-1}
  Line(1 + i) = {1 + i, 1 + (i + 1) % n};
EndFor
Curve Loop(1) = {1:n};
Plane Surface(1) = {1};
Mesh.Algorithm = 6;
Physical Curve("cage") = {1:n};
Physical Surface("inside") = {1};

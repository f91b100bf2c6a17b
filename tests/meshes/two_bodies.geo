// The paper's first case: two smooth closed bodies in a rectangle. The paper gives no coordinates; these shapes are drawn
// after its description, with the cubic curves of two_bodies_left.curve (11 control points) and two_bodies_right.curve (9).
rectangle = 0.16;  // sizes of triangles
body = 0.035;

Point(1) = {0, 0, 0, rectangle};
Point(2) = {4, 0, 0, rectangle};
Point(3) = {4, 2.4, 0, rectangle};
Point(4) = {0, 2.4, 0, rectangle};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};

Point(101) = {1.72, 1.13, 0, body};
Point(102) = {1.60, 1.36, 0, body};
Point(103) = {1.34, 1.56, 0, body};
Point(104) = {1.02, 1.64, 0, body};
Point(105) = {0.72, 1.50, 0, body};
Point(106) = {0.56, 1.22, 0, body};
Point(107) = {0.66, 0.96, 0, body};
Point(108) = {0.90, 0.92, 0, body};
Point(109) = {1.14, 1.08, 0, body};
Point(110) = {1.36, 1.04, 0, body};
Point(111) = {1.58, 0.94, 0, body};
BSpline(5) = {101, 102, 103, 104, 105, 106, 107, 108, 109, 110, 111, 101};

Point(201) = {3.36, 1.10, 0, body};
Point(202) = {3.28, 1.42, 0, body};
Point(203) = {3.00, 1.62, 0, body};
Point(204) = {2.68, 1.56, 0, body};
Point(205) = {2.46, 1.30, 0, body};
Point(206) = {2.44, 0.98, 0, body};
Point(207) = {2.64, 0.74, 0, body};
Point(208) = {2.94, 0.66, 0, body};
Point(209) = {3.22, 0.80, 0, body};
BSpline(6) = {201, 202, 203, 204, 205, 206, 207, 208, 209, 201};

Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5};
Curve Loop(3) = {6};
Plane Surface(1) = {1, 2, 3};

Mesh.Algorithm = 6;  // frontal-Delaunay: nearly equilateral
Mesh.MeshSizeExtendFromBoundary = 1;
Physical Curve("rectangle") = {1, 2, 3, 4};
Physical Curve("left") = {5};
Physical Curve("right") = {6};
Physical Surface("fluid") = {1};

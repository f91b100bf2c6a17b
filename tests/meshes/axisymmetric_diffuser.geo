// The paper's first figure: an axisymmetric diffuser in the half plane above its axis. The paper gives no coordinates; this
// shape is drawn after its description, with the cubic curve of axisymmetric_diffuser.curve (11 control points).
far = 0.3;  // sizes of triangles
body = 0.032;

Point(101) = {1.22, 1.02, 0, body};
Point(102) = {1.02, 1.04, 0, body};
Point(103) = {0.72, 0.90, 0, body};
Point(104) = {0.40, 0.82, 0, body};
Point(105) = {0.08, 0.82, 0, body};
Point(106) = {-0.14, 0.76, 0, body};
Point(107) = {-0.14, 0.64, 0, body};
Point(108) = {0.08, 0.58, 0, body};
Point(109) = {0.40, 0.62, 0, body};
Point(110) = {0.72, 0.74, 0, body};
Point(111) = {1.04, 0.92, 0, body};
BSpline(5) = {101, 102, 103, 104, 105, 106, 107, 108, 109, 110, 111, 101};

Point(1) = {-1.8, 0, 0, 0.12};
Point(2) = {3.2, 0, 0, 0.12};
Point(3) = {3.2, 2.6, 0, far};
Point(4) = {-1.8, 2.6, 0, far};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5};
Plane Surface(1) = {1, 2};

Mesh.Algorithm = 6;  // frontal-Delaunay: nearly equilateral
Physical Curve("axis") = {1};
Physical Curve("far") = {2, 3, 4};
Physical Curve("diffuser") = {5};
Physical Surface("fluid") = {1};

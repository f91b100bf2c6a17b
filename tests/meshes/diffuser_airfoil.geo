// The paper's second case: the airfoil of a diffuser-augmented wind turbine's diffuser, flow from the left, axis below (outside
// the picture). The paper gives no coordinates; this shape is drawn after its description, with the quadratic curve of
// diffuser_airfoil.curve (14 control points). Quads in layers round the airfoil, triangles elsewhere.
x[] = {1.00, 0.96, 0.80, 0.60, 0.40, 0.20, 0.05, -0.05, -0.02, 0.10, 0.28, 0.50, 0.74, 0.95};
y[] = {0.430, 0.455, 0.370, 0.270, 0.190, 0.135, 0.105, 0.035, -0.045, -0.060, -0.015, 0.075, 0.220, 0.375};
n = 14;
far = 0.45;  // sizes of triangles
body = 0.035;

// Each span of the quadratic curve is a Bezier curve; gmsh's are cubic, so degrees are elevated. Spans join half-way between
// control points.
For i In {0:n-1}
  j = (i + 1) % n;
  Point(100 + i) = {0.5 * (x[i] + x[j]), 0.5 * (y[i] + y[j]), 0, body};
EndFor
For i In {0:n-1}
  j = (i + 1) % n;
  k = (i + 2) % n;
  Point(200 + i) = {(x[i] + 5 * x[j]) / 6, (y[i] + 5 * y[j]) / 6, 0, body};
  Point(300 + i) = {(5 * x[j] + x[k]) / 6, (5 * y[j] + y[k]) / 6, 0, body};
  Bezier(100 + i) = {100 + i, 200 + i, 300 + i, 100 + j};
EndFor

Transfinite Curve {100:100+n-1} = 7;

Point(1) = {-2.5, -2.2, 0, far};
Point(2) = {4, -2.2, 0, far};
Point(3) = {4, 2.8, 0, far};
Point(4) = {-2.5, 2.8, 0, far};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {100:100+n-1};
Plane Surface(1) = {1, 2};

Field[1] = BoundaryLayer;
Field[1].CurvesList = {100:100+n-1};
Field[1].Size = 0.006;
Field[1].Ratio = 1.3;
Field[1].Thickness = 0.05;
Field[1].Quads = 1;
BoundaryLayer Field = 1;

Mesh.Algorithm = 6;  // frontal-Delaunay: nearly equilateral
Physical Curve("far") = {1, 2, 3, 4};
Physical Curve("airfoil") = {100:100+n-1};
Physical Surface("fluid") = {1};

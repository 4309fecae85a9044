// A quarter of clay around and under a circular footing, for circle.toml:
//
//   gmsh -3 -format msh41 -o circle.msh circle.geo
//
// Lengths in m; y points up. Edges are f long under the footing and grow to h.
DefineConstant[ f = 0.1, h = 0.6 ];
R = 1;
L = 4;
H = 3;
Point(1) = {0, 0, 0, f};
Point(2) = {R, 0, 0, f};
Point(3) = {L, 0, 0, h};
Point(4) = {L, 0, L, h};
Point(5) = {0, 0, L, h};
Point(6) = {0, 0, R, f};
Point(11) = {0, -H, 0, h};
Point(13) = {L, -H, 0, h};
Point(14) = {L, -H, L, h};
Point(15) = {0, -H, L, h};
Line(1) = {1, 2};
Circle(2) = {2, 1, 6};
Line(3) = {6, 1};
Line(4) = {2, 3};
Line(5) = {3, 4};
Line(6) = {4, 5};
Line(7) = {5, 6};
Line(11) = {1, 11};
Line(13) = {3, 13};
Line(14) = {4, 14};
Line(15) = {5, 15};
Line(21) = {11, 13};
Line(22) = {13, 14};
Line(23) = {14, 15};
Line(24) = {15, 11};
Curve Loop(1) = {1, 2, 3};
Curve Loop(2) = {4, 5, 6, 7, -2};
Curve Loop(3) = {1, 4, 13, -21, -11};
Curve Loop(4) = {5, 14, -22, -13};
Curve Loop(5) = {6, 15, -23, -14};
Curve Loop(6) = {7, 3, 11, -24, -15};
Curve Loop(7) = {21, 22, 23, 24};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};
Plane Surface(5) = {5};
Plane Surface(6) = {6};
Plane Surface(7) = {7};
Surface Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Volume(1) = {1};
Physical Volume("clay") = {1};
Physical Surface("footing") = {1};
Physical Surface("surface") = {2};
Physical Surface("cuts") = {3, 6};
Physical Surface("far") = {4, 5, 7};

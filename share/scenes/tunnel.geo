// A slope of soft clay over stiffer clay with a tunnel, for tunnel.toml:
//
//   gmsh -2 -format msh41 -o tunnel.msh tunnel.geo
//
// Lengths in m; only the outlines of the physical groups count for fpm-run and fpm-limit.
h = 1.4;
r = 0.7;
f = 0.1;
Point(1) = {-8, -4, 0, h};
Point(2) = {10, -4, 0, h};
Point(3) = {10, -2, 0, h};
Point(4) = {7, -2, 0, h};
Point(5) = {6, -1.5, 0, h};
Point(6) = {3, 0, 0, h};
Point(7) = {2, 0, 0, h};
Point(8) = {0, 0, 0, h};
Point(9) = {-8, 0, 0, h};
Point(10) = {-8, -0.5, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 10};
Line(6) = {10, 1};
Line(7) = {5, 6};
Line(8) = {6, 7};
Line(9) = {7, 8};
Line(10) = {8, 9};
Line(11) = {9, 10};
Point(20) = {1, -1.9, 0, f};
Point(21) = {1 + r, -1.9, 0, f};
Point(22) = {1, -1.9 + r, 0, f};
Point(23) = {1 - r, -1.9, 0, f};
Point(24) = {1, -1.9 - r, 0, f};
Circle(20) = {21, 20, 22};
Circle(21) = {22, 20, 23};
Circle(22) = {23, 20, 24};
Circle(23) = {24, 20, 21};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Curve Loop(2) = {7, 8, 9, 10, 11, -5};
Curve Loop(3) = {20, 21, 22, 23};
Plane Surface(1) = {1, 3};
Plane Surface(2) = {2};
Recombine Surface{1};
Physical Surface("stiff clay") = {1};
Physical Surface("soft clay") = {2};
Physical Curve("tunnel") = {20, 21, 22, 23};
Physical Curve("footing") = {9};
Physical Curve("level") = {10};
Physical Curve("slope") = {8, 7, 4, 3};
Physical Curve("base") = {1};
Physical Curve("left") = {6, 11};
Physical Curve("right") = {2};

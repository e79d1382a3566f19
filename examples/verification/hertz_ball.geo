// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter (x, y > 0) of the lower half of a ball of radius 1, fine at its lowest point: a sector
// in the plane y = 0, turned by 90 degrees about z. The cap of its arc is the contact surface.
c = Sqrt(3) / 2;
Point(1) = {0, 0, 0, 0.009};
Point(2) = {c, 0, 0.5, 0.25};
Point(3) = {1, 0, 1, 0.25};
Point(4) = {0, 0, 1, 0.25};
Point(5) = {0.2, 0, 1 - Sqrt(1 - 0.04), 0.009};
Point(6) = {0, 0, 0.2, 0.04};
Circle(1) = {1, 4, 5};
Circle(2) = {5, 4, 2};
Circle(3) = {2, 4, 3};
Line(4) = {3, 4};
Line(5) = {4, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
e[] = Extrude{ {0, 0, 1}, {0, 0, 0}, Pi / 2 }{ Surface{1}; };
Physical Volume("ball") = {e[1]};
Physical Surface("front") = {1};
Physical Surface("left") = {e[0]};
Physical Surface("cap") = {e[2], e[3]};
Physical Surface("round") = {e[4]};
Physical Surface("top") = {e[5]};

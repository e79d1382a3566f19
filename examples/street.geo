// SPDX-License-Identifier: LGPL-2.1-or-later
// A street with a kerb, whose edge is round. m.
height = 0.05;
radius = 0.03;

Point(1) = {-0.5, -0.1, 0, 0.1};
Point(2) = {1.4, -0.1, 0, 0.1};
Point(3) = {1.4, height, 0, 0.02};
Point(4) = {0.3 + radius, height, 0, 0.008};
Point(5) = {0.3 + radius, height - radius, 0, 0.02};
Point(6) = {0.3, height - radius, 0, 0.008};
Point(7) = {0.3, 0, 0, 0.015};
Point(8) = {-0.5, 0, 0, 0.02};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Circle(4) = {4, 5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 1};

Curve Loop(1) = {1:7};
Plane Surface(1) = {1};

Physical Surface("street") = {1};
Physical Curve("top") = {3:6};
Physical Curve("ground") = {1, 2, 7};

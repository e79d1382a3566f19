// SPDX-License-Identifier: LGPL-2.1-or-later
// One of nine stones of a semicircular arch of mean radius 1 m: the keystone, included by
// stone_thick.geo and stone_thin.geo, which give its `thickness`.
half  = Pi / 18; // half its angle
inner = 1 - thickness / 2;
outer = 1 + thickness / 2;

Point(1) = {-inner * Sin(half), inner * Cos(half), 0};
Point(2) = {inner * Sin(half), inner * Cos(half), 0};
Point(3) = {outer * Sin(half), outer * Cos(half), 0};
Point(4) = {-outer * Sin(half), outer * Cos(half), 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};

Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 7;
Transfinite Curve {2, 4} = 5;
Transfinite Surface {1};
Recombine Surface {1};

Physical Surface("stone") = {1};
Physical Curve("left") = {4};
Physical Curve("right") = {2};
Physical Curve("rest") = {1, 3};

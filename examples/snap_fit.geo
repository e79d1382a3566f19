// SPDX-License-Identifier: LGPL-2.1-or-later
// A hook on an arm: the arm lies on y = 0 and the hook looks down. mm.
length = 30;
thick  = 2;
catch  = 1.5;                        // how far the hook looks out
front  = catch / Tan(30 * Pi / 180); // length of its front
size   = 0.35;
fine   = 0.25; // at the head

Point(1) = {0, 0, 0, size};
Point(2) = {length, 0, 0, size};                // behind the hook
Point(3) = {length + 0.6, -catch, 0, fine};
Point(4) = {length + 1.6, -catch, 0, fine};     // the front begins
Point(5) = {length + 1.6 + front, 0, 0, size};
Point(6) = {length + 1.6 + front, thick, 0, size};
Point(7) = {length, thick, 0, size};
Point(8) = {0, thick, 0, size};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};
Line(9) = {2, 7};

Curve Loop(1) = {1, 9, 7, 8};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, 5, 6, -9};
Plane Surface(2) = {2};

// Six cells through the arm.
Transfinite Curve {1, 7} = 76;
Transfinite Curve {8, 9} = 7;
Transfinite Surface {1};
Recombine Surface {1, 2};

Physical Surface("hook") = {1, 2};
Physical Curve("root") = {8};
Physical Curve("head") = {2, 3, 4};
Physical Curve("rest") = {1, 5, 6, 7};

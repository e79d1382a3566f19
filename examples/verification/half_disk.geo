// SPDX-License-Identifier: LGPL-2.1-or-later
// A half disk of radius 8 below y = 0, in quadrilaterals, with elements of one degree on its arc.
r = 8;
s = 4; // half of the square inside
n = 45;
d = r / Sqrt(2);
e = 0.6 * s;
Point(1) = {0, 0, 0};
Point(2) = {-r, 0, 0};
Point(3) = {-d, -d, 0};
Point(4) = {0, -r, 0};
Point(5) = {d, -d, 0};
Point(6) = {r, 0, 0};
Point(12) = {-s, 0, 0};
Point(13) = {-e, -e, 0};
Point(14) = {0, -s, 0};
Point(15) = {e, -e, 0};
Point(16) = {s, 0, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 6};
Line(11) = {12, 13};
Line(12) = {13, 14};
Line(13) = {14, 15};
Line(14) = {15, 16};
Line(21) = {2, 12};
Line(22) = {3, 13};
Line(23) = {4, 14};
Line(24) = {5, 15};
Line(25) = {6, 16};
Line(31) = {12, 1};
Line(32) = {14, 1};
Line(33) = {16, 1};
Curve Loop(1) = {1, 22, -11, -21};
Curve Loop(2) = {2, 23, -12, -22};
Curve Loop(3) = {3, 24, -13, -23};
Curve Loop(4) = {4, 25, -14, -24};
Curve Loop(5) = {11, 12, 32, -31};
Curve Loop(6) = {13, 14, 33, -32};
For k In {1:6}
  Plane Surface(k) = {k};
EndFor
Transfinite Curve {1:4, 11:14, 31, 32, 33} = n + 1;
Transfinite Curve {21:25} = 36 Using Progression 1.03;
Transfinite Surface {1:6};
Recombine Surface {1:6};
Physical Surface("cylinder") = {1:6};
Physical Curve("arc") = {1:4};
Physical Curve("top") = {21, 31, 33, 25};

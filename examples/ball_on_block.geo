// SPDX-License-Identifier: LGPL-2.1-or-later
// The ball of ball_on_block.prm, of hexahedra: a cube in the middle and six blocks around
// it, with n cells along each edge.
radius = 0.5;
inner  = 0.25; // half the diagonal of the cube
n      = 8;

Point(1) = {0, 0, 0};
// Corners of the sphere (10 on) and of the cube (20 on), four below and four above.
For i In {0:7}
  x = (i % 4 == 0 || i % 4 == 3) ? -1 : 1;
  y = (i % 4 < 2) ? -1 : 1;
  z = (i < 4) ? -1 : 1;
  r = radius / Sqrt(3);
  s = inner / Sqrt(3);
  Point(10 + i) = {r * x, r * y, r * z};
  Point(20 + i) = {s * x, s * y, s * z};
  Line(60 + i)  = {20 + i, 10 + i};
EndFor
// Edges: 0 to 3 below, 4 to 7 above, 8 to 11 from below to above; then what lies between
// those of the sphere (30 on) and of the cube (45 on).
For i In {0:11}
  a = (i < 8) ? i : i - 8;
  b = (i < 4) ? (i + 1) % 4 : i - 4;
  If (i > 3 && i < 8)
    b = 4 + (i + 1) % 4;
  EndIf
  Circle(30 + i) = {10 + a, 1, 10 + b};
  Line(45 + i)   = {20 + a, 20 + b};
  Curve Loop(100 + i)    = {45 + i, 60 + b, -(30 + i), -(60 + a)};
  Plane Surface(100 + i) = {100 + i};
EndFor
// Six faces: below, above, and around.
For i In {0:5}
  edges[] = {4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3};
  signs[] = {1, 1, 1, 1};
  If (i > 1)
    k       = i - 2;
    edges[] = {k, 8 + (k + 1) % 4, 4 + k, 8 + k};
    signs[] = {1, 1, -1, -1};
  EndIf
  sphere[] = {};
  cube[]   = {};
  sides[]  = {};
  For j In {0:3}
    sphere[] += {signs[j] * (30 + edges[j])};
    cube[] += {signs[j] * (45 + edges[j])};
    sides[] += {100 + edges[j]};
  EndFor
  Curve Loop(120 + i)    = {sphere[]};
  Surface(120 + i)       = {120 + i} In Sphere {1};
  Curve Loop(130 + i)    = {cube[]};
  Plane Surface(130 + i) = {130 + i};
  Surface Loop(140 + i)  = {120 + i, 130 + i, sides[]};
  Volume(140 + i)        = {140 + i};
EndFor
Surface Loop(150) = {130:135};
Volume(150)       = {150};

Transfinite Curve {30:41, 45:56, 60:67} = n + 1;
Transfinite Surface {100:111, 120:125, 130:135};
Recombine Surface {100:111, 120:125, 130:135};
Transfinite Volume {140:145, 150};

Physical Volume("ball", 1)     = {140:145, 150};
Physical Surface("sole", 1)    = {120};
Physical Surface("cap", 2)     = {121};
Physical Surface("around", 3)  = {122:125};

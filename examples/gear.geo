// SPDX-License-Identifier: LGPL-2.1-or-later
// A gear with `teeth` involute teeth, included by gear_16.geo and gear_24.geo. mm.
// The first tooth looks to the right.
module   = 2;
pressure = 20 * Pi / 180; // angle
backlash = 0.004;         // angle that half a tooth is thinner by, times pitch radius/10
hole     = 10;            // radius

pitch = module * teeth / 2;
base  = pitch * Cos(pressure);
tip   = pitch + module;
root  = pitch - 1.25 * module;
n     = 6; // points of a flank

Point(1) = {0, 0, 0};

// Half the angle of a tooth at a radius: Pi/(2 teeth) + inv(pressure) - inv(there).
For i In {0:teeth - 1}
  For side In {-1:1:2}
    angle = Pi / (2 * teeth) - backlash * 10 / pitch + Tan(pressure) - pressure;
    first = newp;
    // The foot lies below the base circle, where there is no involute.
    a = 2 * Pi * i / teeth + side * angle * 1.12;
    Point(first) = {root * Cos(a), root * Sin(a), 0, 1.0};
    For k In {0:n - 1}
      r = base * 1.001 + (tip - base * 1.001) * k / (n - 1);
      c = Acos(base / r);
      a = 2 * Pi * i / teeth + side * (angle - (Tan(c) - c));
      Point(first + 1 + k) = {r * Cos(a), r * Sin(a), 0, 0.6};
    EndFor
    foot  = newl;
    Line(foot) = {first, first + 1};
    flank = newl;
    Spline(flank) = {first + 1:first + n};
    Transfinite Curve {flank} = 8;
    If (side == -1)
      right      = first;
      right_foot = foot;
      right_edge = flank;
    Else
      top = newl;
      Line(top) = {right + n, first + n};
      If (i == 0)
        first_right = right;
        outline[]   = {right_foot, right_edge, top, -flank, -foot};
      Else
        bottom = newl;
        Line(bottom) = {last_left, right};
        outline[] += {bottom, right_foot, right_edge, top, -flank, -foot};
      EndIf
      last_left = first;
    EndIf
  EndFor
EndFor
bottom = newl;
Line(bottom) = {last_left, first_right};
outline[] += {bottom};

For i In {0:3}
  p = newp;
  Point(p) = {hole * Cos(i * Pi / 2), hole * Sin(i * Pi / 2), 0, 2.5};
  rim[i] = p;
EndFor
For i In {0:3}
  l = newl;
  Circle(l) = {rim[i], 1, rim[(i + 1) % 4]};
  hub[i] = l;
EndFor

Curve Loop(1) = outline[];
Curve Loop(2) = hub[];
Plane Surface(1) = {1, 2};

Physical Surface("gear") = {1};
Physical Curve("teeth") = outline[];
Physical Curve("hub") = hub[];

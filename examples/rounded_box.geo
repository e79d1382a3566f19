// SPDX-License-Identifier: LGPL-2.1-or-later
// A box of 100 x 80 x 60 mm whose edges are rounded by 15 mm.
SetFactory("OpenCASCADE");
Box(1)    = {-0.05, -0.04, -0.03, 0.1, 0.08, 0.06};
Fillet{1}{1 : 12}{0.015}
Physical Volume("box") = {1};
Physical Surface("right", 1) = Surface In BoundingBox{0.0499, -1, -1, 0.0501, 1, 1};
Physical Surface("left", 2) = Surface In BoundingBox{-0.0501, -1, -1, -0.0499, 1, 1};
all() = Boundary{ Volume{1}; };
all() -= Surface In BoundingBox{0.0499, -1, -1, 0.0501, 1, 1};
all() -= Surface In BoundingBox{-0.0501, -1, -1, -0.0499, 1, 1};
Physical Surface("rest", 3) = {all()};
Mesh.MeshSizeMin = 0.014;
Mesh.MeshSizeMax = 0.014;

// SPDX-License-Identifier: LGPL-2.1-or-later
thickness = 0.06;
Include "stone.geo";

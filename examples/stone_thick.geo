// SPDX-License-Identifier: LGPL-2.1-or-later
thickness = 0.18;
Include "stone.geo";

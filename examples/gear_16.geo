// SPDX-License-Identifier: LGPL-2.1-or-later
teeth = 16;
Include "gear.geo";

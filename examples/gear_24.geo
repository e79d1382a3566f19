// SPDX-License-Identifier: LGPL-2.1-or-later
teeth = 24;
Include "gear.geo";

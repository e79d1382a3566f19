# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two disks that collide.

No paper has them; they are compared with laws of conservation, and with each other.
"""

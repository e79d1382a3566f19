# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two disks that collide.

No paper has them; what they are compared with are laws of conservation, and each other.
"""

// SPDX-License-Identifier: GPL-3.0-or-later
#define PGDR_INSTANTIATE template
#include <pgdr/refine_mesh_3.h>

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_WRITE_POLY_H
#define PGDR_IO_WRITE_POLY_H

#include <filesystem>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// Writes a PLC as TetGen's `.poly`, numbered from `plc.first_index`; `read_plc` gives the same PLC back,
/// bit for bit.
///
/// Explicit segments go last, each as a facet of one two-vertex polygon. `plc.nesting` has no place in the
/// format: reading gives `Nesting::fill`. Throws `Output_error`; the file appears complete or not at all.
void write_poly(const Plc& plc, const std::filesystem::path& path);

}  // namespace pgdr

#endif

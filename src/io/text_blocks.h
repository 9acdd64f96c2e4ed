// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/io: rows of text, formatted on all threads.
#ifndef PGDR_SRC_IO_TEXT_BLOCKS_H
#define PGDR_SRC_IO_TEXT_BLOCKS_H

#include <algorithm>
#include <cstddef>
#include <memory>

#include <pgdr/io/atomic_file.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_in_order.h>

#include "numbers.h"

namespace pgdr::io_detail {

/// Writes `count` rows of at most `columns` numbers, each with a character behind it. `format(first, last, out)` turns the rows
/// [first, last) into text, knows of no others and returns the end; blocks are formatted at once on all threads and written in order.
template <class Format>
void write_rows(Atomic_file& out, std::size_t count, std::size_t columns, const Format& format) {
  constexpr std::size_t block_rows = 8192;
  struct Block {
    std::unique_ptr<char[]> text;
    std::size_t size = 0;
  };
  parallel_in_order<Block>(
      chunk_count(count, block_rows),
      [&](std::size_t i, Block& block) {
        if (!block.text) block.text = std::make_unique_for_overwrite<char[]>(block_rows * columns * (max_number_length + 1));
        const std::size_t first = i * block_rows, last = std::min(first + block_rows, count);
        block.size = static_cast<std::size_t>(format(first, last, block.text.get()) - block.text.get());
      },
      [&](std::size_t, const Block& block) { out.write(block.text.get(), block.size); });
}

}  // namespace pgdr::io_detail

#endif

// Work in independent parts, of which each process does some and receives the results of the others.
#pragma once

#include "core/base/packed_numbers.h"
#include "operators/fields/matrix/row_share.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace neumann {

// Shares the results of found.size() parts: process p has found the p-th share (RowShare::cut), and afterwards all
// processes have all results. All processes must call it together. Results have pack(PackedNumbers&), and a static
// unpacked(UnpackedNumbers&) that is its inverse.
template <class Found>
void exchange_results(const RowShare& rows, std::span<Found> found) {
    const std::vector<std::size_t> cut = rows.cut(found.size());
    PackedNumbers packed;
    for (std::size_t i = cut[rows.rank()]; i < cut[rows.rank() + 1]; ++i) found[i].pack(packed);
    const std::vector<std::byte> own = std::move(packed).bytes();

    // Processes can only exchange doubles.
    constexpr std::size_t word = sizeof(double);
    std::vector<double> sizes(cut.size() - 1);
    sizes[rows.rank()] = static_cast<double>(own.size());
    rows.sum(sizes);
    std::vector<std::size_t> first{0};
    for (const double size : sizes) first.push_back(first.back() + (static_cast<std::size_t>(size) + word - 1) / word);
    std::vector<double> all(first.back());
    if (!own.empty()) std::memcpy(all.data() + first[rows.rank()], own.data(), own.size());
    rows.complete(all, first);
    for (std::size_t p = 0; p + 1 < cut.size(); ++p) {
        UnpackedNumbers numbers(std::as_bytes(std::span(all)).subspan(first[p] * word));
        for (std::size_t i = cut[p]; i < cut[p + 1]; ++i) found[i] = Found::unpacked(numbers);
    }
}

}  // namespace neumann

// Independent parts of some work, of which each process does some and is told what the others found.
#pragma once

#include "operators/matrix/row_share.h"

#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace neumann {

// The numbers of a result as bytes, and back. Results have for_each_member(f), which calls f(x) for members that are a number or a
// vector of plain structures.
class PackedResults {
public:
    template <class Found>
    void add(Found& found) {
        found.for_each_member([&]<class T>(T& x) {
            if constexpr (std::is_arithmetic_v<T>) {
                add_bytes(&x, sizeof x);
            } else {
                static_assert(std::is_trivially_copyable_v<typename T::value_type>);
                const std::uint64_t size = x.size();
                add_bytes(&size, sizeof size);
                add_bytes(x.data(), x.size() * sizeof(typename T::value_type));
            }
        });
    }
    template <class Found>
    void take(Found& found) {
        found.for_each_member([&]<class T>(T& x) {
            if constexpr (std::is_arithmetic_v<T>) {
                take_bytes(&x, sizeof x);
            } else {
                using Value = typename T::value_type;
                std::uint64_t size = 0;
                take_bytes(&size, sizeof size);
                std::vector<std::byte> bytes(size * sizeof(Value));
                take_bytes(bytes.data(), bytes.size());
                const auto* const values = reinterpret_cast<const Value*>(bytes.data());
                x.assign(values, values + size);
            }
        });
    }
    std::vector<double>& numbers() { return numbers_; }

private:
    void add_bytes(const void* from, std::size_t size) {
        numbers_.resize(numbers_.size() + words(size));
        if (size > 0) std::memcpy(numbers_.data() + numbers_.size() - words(size), from, size);
    }
    void take_bytes(void* to, std::size_t size) {
        if (size > 0) std::memcpy(to, numbers_.data() + next_, size);
        next_ += words(size);
    }
    static std::size_t words(std::size_t bytes) { return (bytes + sizeof(double) - 1) / sizeof(double); }

    std::vector<double> numbers_;  // as processes tell each other
    std::size_t next_ = 0;
};

// Of found.size() parts, process p has found the p-th share (RowShare::cut); afterwards all have all. For all of them together.
template <class Found>
void tell_all(const RowShare& rows, std::span<Found> found) {
    const std::vector<std::size_t> cut = rows.cut(found.size());
    PackedResults own;
    for (std::size_t i = cut[rows.rank()]; i < cut[rows.rank() + 1]; ++i) own.add(found[i]);
    std::vector<double> sizes(cut.size() - 1);
    sizes[rows.rank()] = static_cast<double>(own.numbers().size());
    rows.sum(sizes);
    std::vector<std::size_t> first{0};
    for (const double size : sizes) first.push_back(first.back() + static_cast<std::size_t>(size));
    PackedResults all;
    all.numbers().resize(first.back());
    std::copy(own.numbers().begin(), own.numbers().end(), all.numbers().begin() + static_cast<std::ptrdiff_t>(first[rows.rank()]));
    rows.complete(all.numbers(), first);
    for (Found& f : found) all.take(f);
}

}  // namespace neumann

// Memory that is soon written from end to end. It is in huge pages if the system has them, for the faults of small
// pages take as long as the writing.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace neumann {

struct FreeMemory {
    void operator()(void* memory) const { std::free(memory); }
};
template <class T>
using LargeArray = std::unique_ptr<T[], FreeMemory>;

// The values of the array are not set. Throws std::bad_alloc.
template <class T>
LargeArray<T> make_large_array(std::size_t size) {
    static_assert(std::is_trivial_v<T>);
    constexpr std::size_t page = std::size_t{2} << 20;
    const std::size_t bytes = (size * sizeof(T) + page - 1) / page * page;
    void* const memory = std::aligned_alloc(page, bytes);
    if (!memory) throw std::bad_alloc();
    madvise(memory, bytes, MADV_HUGEPAGE);  // a hint, which the system may ignore
    return LargeArray<T>(static_cast<T*>(memory));
}

// Does v.resize(size) with such memory.
template <class T>
void resize_large(std::vector<T>& v, std::size_t size) {
    constexpr std::size_t page = 4096;
    if (v.capacity() < size) {
        v.reserve(size);
        const std::size_t before = -reinterpret_cast<std::uintptr_t>(v.data()) % page, bytes = size * sizeof(T);
        if (bytes > before) madvise(reinterpret_cast<char*>(v.data()) + before, (bytes - before) / page * page, MADV_HUGEPAGE);
    }
    v.resize(size);
}

}  // namespace neumann

// Plain structures as bytes, one after the other as they are in memory, for another process of the same program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace neumann {

class PackedNumbers {
public:
    explicit PackedNumbers(std::size_t expected = 0) { bytes_.reserve(expected); }
    template <class T>
    void number(const T& x) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* const at = reinterpret_cast<const std::byte*>(&x);
        bytes_.insert(bytes_.end(), at, at + sizeof x);
    }
    template <class T>
    void numbers(const std::vector<T>& all) {
        static_assert(std::is_trivially_copyable_v<T>);
        number<std::uint64_t>(all.size());
        const auto* const at = reinterpret_cast<const std::byte*>(all.data());
        bytes_.insert(bytes_.end(), at, at + all.size() * sizeof(T));
    }
    std::vector<std::byte> bytes() && { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

class UnpackedNumbers {
public:
    explicit UnpackedNumbers(std::span<const std::byte> bytes) : left_(bytes) {}
    template <class T>
    T number() {
        T x{};
        take(&x, sizeof x);
        return x;
    }
    template <class T>
    std::vector<T> numbers() {
        const auto size = number<std::uint64_t>();
        if (size > left_.size() / sizeof(T)) throw std::logic_error("a message is too short");
        std::vector<T> all(size);
        take(all.data(), size * sizeof(T));
        return all;
    }

private:
    void take(void* to, std::size_t bytes) {
        if (bytes > left_.size()) throw std::logic_error("a message is too short");
        if (bytes > 0) std::memcpy(to, left_.data(), bytes);
        left_ = left_.subspan(bytes);
    }
    std::span<const std::byte> left_;
};

}  // namespace neumann

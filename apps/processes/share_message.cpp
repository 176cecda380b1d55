#include "apps/processes/share_message.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace neumann {

namespace {

class Writer {
public:
    explicit Writer(std::size_t expected) { bytes_.reserve(expected); }
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

class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}
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

}  // namespace

std::vector<std::byte> as_bytes(const SampledShare& sampled) {
    const Tally& tally = sampled.tally;
    constexpr std::size_t room_for_tally = 1 << 16;
    Writer out(std::span(sampled.data).size_bytes() + std::span(sampled.ranges.of).size_bytes() + room_for_tally);
    out.numbers(sampled.data);
    out.numbers(sampled.ranges.of);
    out.numbers(tally.rays);
    out.number(tally.given_up);
    out.numbers(tally.non_finite_count);
    out.numbers(tally.non_finite);
    for (const LargestSamples& largest : tally.largest) {
        out.number(largest.count());
        out.numbers(largest.kept());
    }
    return std::move(out).bytes();
}

SampledShare sampled_share_from(std::span<const std::byte> bytes) {
    Reader in(bytes);
    auto data = in.numbers<double>();
    SampleRanges ranges{in.numbers<SampleRange>()};
    auto rays = in.numbers<std::uint64_t>();
    Tally tally(rays.size());
    tally.rays = std::move(rays);
    tally.given_up = in.number<std::uint64_t>();
    tally.non_finite_count = in.numbers<std::uint64_t>();
    tally.non_finite = in.numbers<NonFiniteSample>();
    for (LargestSamples& largest : tally.largest) {
        const auto count = in.number<std::uint64_t>();
        largest = LargestSamples(count, in.numbers<LargestSamples::Sample>());
    }
    return {std::move(data), std::move(ranges), std::move(tally)};
}

}  // namespace neumann

// Limits on the memory and the threads of a command.
#pragma once

#include <memory>
#include <optional>

namespace neumann {

// Converts GiB to bytes; without a value, half of the machine's memory.
double memory_limit(const std::optional<double>& gibibytes);

// Limits the number of threads during its lifetime; 0: all.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();

private:
    struct Limit;
    std::unique_ptr<Limit> limit_;
};

}  // namespace neumann

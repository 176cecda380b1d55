// The processes that a launcher (mpirun, srun) has started together, each with a memory of its own, and messages between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace neumann {

struct Message {
    int from = 0;
    std::string text;
    std::vector<std::byte> numbers;  // as in the memory of the process that sent them
};

// Must not be used by several threads at once. If another process has died, the launcher ends all of them.
class Processes {
public:
    virtual ~Processes() = default;

    // The number of this process, from 0 on, and the number of processes.
    virtual int rank() const = 0;
    virtual int size() const = 0;
    // The number of processes on this machine.
    virtual int on_this_machine() const = 0;
    virtual std::string machine() const = 0;

    // Returns when the message is on its way. Messages from one process to another arrive in the order in which they were sent.
    virtual void send(int to, const std::string& text, std::initializer_list<std::span<const std::byte>> numbers = {}) = 0;
    // A message that has arrived, if there is one.
    virtual std::optional<Message> receive() = 0;

    struct Traffic {
        std::size_t messages = 0, bytes = 0;
    };
    // What this process has sent and received.
    virtual Traffic traffic() const = 0;

    // All processes call each of the following functions together, in the same order.

    // Replace each value by its sum, or its largest value, over all processes: the same bits on all.
    virtual void sum(std::span<double> values) = 0;
    virtual void largest(std::span<double> values) = 0;

    // How many values go to each process, and come from each.
    struct Counts {
        std::vector<int> given, taken;
    };
    // The counts of an exchange, of which each process knows what it gives.
    virtual Counts counts(std::vector<int> given) = 0;
    // Part p of `given` goes to process p, and part p of `taken` comes from there.
    virtual void exchange(std::span<const double> given, std::span<double> taken, const Counts& counts) = 0;
    virtual void exchange(std::span<const std::uint32_t> given, std::span<std::uint32_t> taken, const Counts& counts) = 0;
    virtual void exchange(std::span<const float> given, std::span<float> taken, const Counts& counts) = 0;
    // Completes an array that all have and of which process p knows the values first[p] … first[p + 1] − 1; afterwards
    // all know all.
    virtual void complete(std::span<double> values, std::span<const std::size_t> first) = 0;
    // Sends the values of process 0 to all.
    virtual void share(std::span<float> values) = 0;
};

// Null if this process was started alone. Throws RunError if it was not, and this program was built without MPI.
std::unique_ptr<Processes> launched_processes();

}  // namespace neumann

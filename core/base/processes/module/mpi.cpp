// The only code that knows MPI, apart from PETSc: a module that is loaded if a launcher has started several processes.
#include "core/base/error.h"
#include "core/base/processes/processes.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>

namespace neumann {

namespace {

constexpr int frame_tag = 1, text_tag = 2, numbers_tag = 3;
constexpr std::size_t longest_piece = std::size_t{1} << 30;  // counts are of type int

// By default MPI ends all processes if one has an error, so results need no checks.
class MpiProcesses : public Processes {
public:
    MpiProcesses() {
        int is_there = 0;
        MPI_Initialized(&is_there);
        if (!is_there) {
            int provided = 0;
            MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
        }
        MPI_Comm_dup(MPI_COMM_WORLD, &all_);
        MPI_Comm_rank(all_, &rank_);
        MPI_Comm_size(all_, &size_);
        MPI_Comm here;
        MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here);
        MPI_Comm_size(here, &here_);
        MPI_Comm_free(&here);
    }
    ~MpiProcesses() override {
        MPI_Comm_free(&all_);
        int is_over = 0;
        MPI_Finalized(&is_over);
        if (!is_over) MPI_Finalize();
    }

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    int on_this_machine() const override { return here_; }
    std::string machine() const override {
        std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
        int length = 0;
        MPI_Get_processor_name(name.data(), &length);
        return {name.data(), static_cast<std::size_t>(length)};
    }

    void send(int to, const std::string& text, std::initializer_list<std::span<const std::byte>> numbers) override {
        Frame frame = {text.size(), 0};
        for (const auto& part : numbers) frame[1] += part.size();
        MPI_Send(frame.data(), 2, MPI_UINT64_T, to, frame_tag, all_);
        send_pieces(to, text_tag, std::as_bytes(std::span(text)));
        for (const auto& part : numbers) send_pieces(to, numbers_tag, part);
        count(frame);
    }

    std::optional<Message> receive() override {
        int has_arrived = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, frame_tag, all_, &has_arrived, &status);
        if (!has_arrived) return std::nullopt;
        Message message;
        message.from = status.MPI_SOURCE;
        Frame frame{};
        MPI_Recv(frame.data(), 2, MPI_UINT64_T, message.from, frame_tag, all_, MPI_STATUS_IGNORE);
        message.text.resize(frame[0]);
        receive_all(message.from, text_tag, std::as_writable_bytes(std::span(message.text)));
        message.numbers.resize(frame[1]);
        receive_all(message.from, numbers_tag, message.numbers);
        count(frame);
        return message;
    }

    Traffic traffic() const override { return traffic_; }

    void sum(std::span<double> values) override { reduce(values, MPI_SUM); }
    void largest(std::span<double> values) override { reduce(values, MPI_MAX); }

    Counts counts(std::vector<int> given) override {
        Counts counts{std::move(given), std::vector<int>(static_cast<std::size_t>(size_))};
        MPI_Alltoall(counts.given.data(), 1, MPI_INT, counts.taken.data(), 1, MPI_INT, all_);
        return counts;
    }
    void exchange(std::span<const double> given, std::span<double> taken, const Counts& counts) override {
        exchange(given.data(), taken.data(), counts, MPI_DOUBLE, sizeof(double));
    }
    void exchange(std::span<const std::uint32_t> given, std::span<std::uint32_t> taken, const Counts& counts) override {
        exchange(given.data(), taken.data(), counts, MPI_UINT32_T, sizeof(std::uint32_t));
    }
    void exchange(std::span<const float> given, std::span<float> taken, const Counts& counts) override {
        exchange(given.data(), taken.data(), counts, MPI_FLOAT, sizeof(float));
    }
    void complete(std::span<double> values, std::span<const std::size_t> first) override {
        if (first.back() > std::numeric_limits<int>::max())
            throw RunError(
                "MPI counts what processes tell each other by numbers of 31 bits, which do not suffice for so many unknowns");
        std::vector<int> begin, count;
        for (std::size_t p = 0; p + 1 < first.size(); ++p) {
            begin.push_back(static_cast<int>(first[p]));
            count.push_back(static_cast<int>(first[p + 1] - first[p]));
        }
        MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values.data(), count.data(), begin.data(), MPI_DOUBLE, all_);
        const auto own = static_cast<std::size_t>(count[static_cast<std::size_t>(rank_)]);
        const auto others = static_cast<std::size_t>(size_ - 1);
        traffic_.messages += 2 * others;
        traffic_.bytes += (own * others + first.back() - own) * sizeof(double);
    }
    void share(std::span<float> values) override {
        constexpr std::size_t piece = longest_piece / sizeof(float);
        for (auto left = values; !left.empty(); left = left.subspan(std::min(left.size(), piece)))
            MPI_Bcast(left.data(), static_cast<int>(std::min(left.size(), piece)), MPI_FLOAT, 0, all_);
        const std::size_t times = rank_ == 0 ? static_cast<std::size_t>(size_ - 1) : 1;
        traffic_.messages += times;
        traffic_.bytes += times * values.size_bytes();
    }

private:
    // MPI_Allreduce need not give the same bits everywhere.
    void reduce(std::span<double> values, MPI_Op how) {
        const int n = static_cast<int>(values.size());
        MPI_Reduce(rank_ == 0 ? MPI_IN_PLACE : values.data(), values.data(), n, MPI_DOUBLE, how, 0, all_);
        MPI_Bcast(values.data(), n, MPI_DOUBLE, 0, all_);
    }
    void exchange(const void* given, void* taken, const Counts& counts, MPI_Datatype type, std::size_t bytes) {
        const auto begins = [](const std::vector<int>& n) {
            std::vector<int> begin(n.size());
            std::exclusive_scan(n.begin(), n.end(), begin.begin(), 0);
            return begin;
        };
        MPI_Alltoallv(given, counts.given.data(), begins(counts.given).data(), type, taken, counts.taken.data(),
                      begins(counts.taken).data(), type, all_);
        for (const std::vector<int>* const each : {&counts.given, &counts.taken})
            for (int p = 0; p < size_; ++p) {
                const auto n = static_cast<std::size_t>((*each)[static_cast<std::size_t>(p)]);
                if (p == rank_ || n == 0) continue;
                traffic_.messages += 1;
                traffic_.bytes += n * bytes;
            }
    }
    using Frame = std::array<std::uint64_t, 2>;  // bytes of the text and of the numbers

    void count(const Frame& frame) {
        traffic_.messages += 1;
        traffic_.bytes += frame[0] + frame[1] + sizeof frame;
    }
    void send_pieces(int to, int tag, std::span<const std::byte> all) {
        for (; !all.empty(); all = all.subspan(std::min(all.size(), longest_piece)))
            MPI_Send(all.data(), static_cast<int>(std::min(all.size(), longest_piece)), MPI_BYTE, to, tag, all_);
    }
    // Receives the bytes in whatever pieces they come.
    void receive_all(int from, int tag, std::span<std::byte> all) {
        while (!all.empty()) {
            MPI_Status status;
            MPI_Recv(all.data(), static_cast<int>(std::min(all.size(), longest_piece)), MPI_BYTE, from, tag, all_, &status);
            int received = 0;
            MPI_Get_count(&status, MPI_BYTE, &received);
            all = all.subspan(static_cast<std::size_t>(received));
        }
    }

    MPI_Comm all_ = MPI_COMM_NULL;
    int rank_ = 0, size_ = 1, here_ = 1;
    Traffic traffic_;
};

}  // namespace
}  // namespace neumann

extern "C" neumann::Processes* neumann_processes() { return new neumann::MpiProcesses; }

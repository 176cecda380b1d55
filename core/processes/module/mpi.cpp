// All that knows MPI, but for PETSc: a module that is loaded where a launcher has started several processes.
#include "core/processes/processes.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace neumann {

namespace {

constexpr int frame_tag = 1, text_tag = 2, numbers_tag = 3;
constexpr std::size_t longest_piece = std::size_t{1} << 30;  // counts are of type int

// MPI's default is to end all processes where one has an error, so that results need no checks.
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

private:
    using Frame = std::array<std::uint64_t, 2>;  // bytes of the text and of the numbers

    void count(const Frame& frame) {
        traffic_.messages += 1;
        traffic_.bytes += frame[0] + frame[1] + sizeof frame;
    }
    void send_pieces(int to, int tag, std::span<const std::byte> all) {
        for (; !all.empty(); all = all.subspan(std::min(all.size(), longest_piece)))
            MPI_Send(all.data(), static_cast<int>(std::min(all.size(), longest_piece)), MPI_BYTE, to, tag, all_);
    }
    // In whatever pieces it comes.
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

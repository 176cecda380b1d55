#include "apps/output/files/new_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace neumann {

namespace {

// Returns 0, or the error number.
int write_all(int file, std::span<const std::string_view> pieces) {
    for (std::string_view bytes : pieces)
        while (!bytes.empty()) {
            const ssize_t count = ::write(file, bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) return errno;
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    return ::fsync(file) == 0 ? 0 : errno;
}

}  // namespace

int open_new_file(const std::filesystem::path& path) {
    ::unlink(path.c_str());
    return ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);  // O_EXCL follows no link
}

int write_new_file(const std::filesystem::path& path, std::span<const std::string_view> pieces) {
    const int file = open_new_file(path);
    if (file < 0) return errno;
    const int written = write_all(file, pieces);
    const int closed = ::close(file) == 0 ? 0 : errno;
    return written != 0 ? written : closed;
}

}  // namespace neumann

#include "apps/output/files/output_folder.h"

#include "apps/output/files/new_file.h"
#include "core/base/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <optional>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace neumann {
namespace {

namespace fs = std::filesystem;

const std::string preview_file = "preview.png";

std::string cannot_be_written(const fs::path& path, int error) {
    return fmt::format("{}: cannot be written: {}", path.string(), std::generic_category().message(error));
}

bool is_numbered(std::string_view name, std::string_view prefix) {
    constexpr std::string_view suffix = ".exr";
    if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() < prefix.size() + 3 + suffix.size()) return false;
    const std::string_view digits = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
    return digits.find_first_not_of("0123456789") == std::string_view::npos;
}

// "way_s1_t3.exr", "way_s1_t3_unweighted.exr"
bool is_way(std::string_view name) {
    static const std::regex pattern("way_s[0-9]+_t[0-9]+(_unweighted)?\\.exr");
    return std::regex_match(name.begin(), name.end(), pattern);
}

// "difference_002.exr", "z_000-001.exr"
bool is_of_blame(std::string_view name) {
    static const std::regex pattern("(difference|z)_[0-9]{3,}(-[0-9]{3,})?\\.exr");
    return std::regex_match(name.begin(), name.end(), pattern);
}

// "rows_002_00017.kept"
bool is_of_rows(std::string_view name) {
    static const std::regex pattern("rows_[0-9]{3,}_[0-9]{5,}\\.kept");
    return std::regex_match(name.begin(), name.end(), pattern);
}

// Flushes a file to the disk. Returns 0, or the error number.
int flush(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return errno;
    const int flushed = ::fsync(file) == 0 ? 0 : errno;
    ::close(file);
    return flushed;
}

// The file names in `folder` for which `wanted` is true.
template <typename Predicate>
std::vector<std::string> names_in(const fs::path& folder, Predicate wanted) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::string name = entry->path().filename().string();
        if (wanted(name)) names.push_back(std::move(name));
    }
    return names;
}

// The command that writes files of this name; "any" if several do.
std::optional<std::string_view> writer_of(std::string_view name) {
    static const std::map<std::string_view, std::vector<std::string_view>> names = {
        {"any", {"run.json", "index.html"}},
        {"render", {"rest.exr",           "layers.exr",           "touch.html",       "contact-sheet.png", "bounces.gif",
                    "series.csv",         "convergence.csv",      "ways.png",         "strip-terms.png",   "strip-terms.gif",
                    preview_file,         unfinished_render_file, samples_file,       "strip-sums.png",    "strip-sums.gif",
                    "strip-doubling.png", "strip-doubling.gif",   "strip-terms.svg",  "strip-sums.svg",    "strip-doubling.svg",
                    "strip-mixture.png",  "figure-decay.svg",     "figure-decay.pdf", "series.tex"}},
        {"study", {"study.csv", "study.json", "figure-error.svg", "figure-error.pdf", "verdict.tex", unfinished_run_file}},
        {"compare", {"compare.json"}},
        {"strip", {"strip.png", "strip.svg", "strip.json"}},
        {"blame", {"blame.json"}},
        {"unbounce", {"unbounce.json", "unbounced.png", "backward_rest.exr"}},
        {"export",
         {"T.mtx", "R.mtx", "R_r.mtx", "R_g.mtx", "R_b.mtx", "K.mtx", "K_r.mtx", "K_g.mtx", "K_b.mtx", "Le.mtx", "b.mtx",
          "measure.mtx", "ray_measure.mtx", "patches.csv"}},
        {"conform", {"picture.exr", "reference.exr", "p-reference.exr", "p-error.exr", "difference.exr"}}};
    if (is_numbered(name, "bounce_") || is_numbered(name, "sum_") || is_way(name)) return "render";
    if (is_of_blame(name)) return "blame";
    for (const std::string_view prefix : {"light_", "direct_", "forward_", "backward_"})
        if (is_numbered(name, prefix)) return "unbounce";
    if (is_of_rows(name)) return "--keep";
    for (const auto& [command, its] : names)
        if (std::find(its.begin(), its.end(), name) != its.end()) return command;
    return std::nullopt;
}

std::string size_text(double bytes) {
    return bytes < 0x1p30 ? fmt::format("{:.3g} MiB", bytes / 0x1p20) : fmt::format("{:.3g} GiB", bytes / 0x1p30);
}

}  // namespace

bool is_output_name(std::string_view name) { return writer_of(name).has_value(); }

void OutputFolder::expect_no_other_files(std::string_view command) const {
    const auto others = names_in(path_, [&](std::string_view name) {
        const auto writer = writer_of(name);
        return writer && *writer != "any" && *writer != command;
    });
    if (!others.empty())
        throw InputError(fmt::format("{} holds {} of {}, which would be lost; expected another folder", path_.string(),
                                     others.front(), *writer_of(others.front())));
}

OutputFolder::OutputFolder(const fs::path& path, std::string_view command, bool locks)
    : path_(path), unfinished_(command == "study" ? unfinished_run_file : unfinished_render_file) {
    if (path.empty()) throw InputError("the output folder has no name");
    expect_no_other_files(command);
    try {
        create();
        open();
        if (locks) {
            lock();
            remove_leftovers();
        }
        // Finds read-only file systems and the like before anything is computed.
        std::string probe = (path_ / ".probe-XXXXXX").string();
        const int file = ::mkostemp(probe.data(), O_CLOEXEC);
        if (file < 0) throw InputError(cannot_be_written(path_, errno));
        ::close(file);
        ::unlink(probe.c_str());
    } catch (...) {
        discard();
        throw;
    }
}

OutputFolder::~OutputFolder() { discard(); }

void OutputFolder::create() {
    std::vector<fs::path> missing;
    for (fs::path folder = path_.has_filename() ? path_ : path_.parent_path(); !folder.empty(); folder = folder.parent_path()) {
        struct stat found {};
        if (::stat(folder.c_str(), &found) == 0 || errno != ENOENT) break;
        missing.push_back(folder);
    }
    std::reverse(missing.begin(), missing.end());
    for (const fs::path& folder : missing) {
        if (::mkdir(folder.c_str(), 0777) == 0) {
            created_.push_back(folder);
        } else if (errno != EEXIST) {
            throw InputError(cannot_be_written(path_, errno));
        }
    }
}

void OutputFolder::open() {
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) throw InputError(cannot_be_written(path_, errno));
}

void OutputFolder::lock() {
    // File systems without locks are accepted.
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(std::exchange(descriptor_, -1));
        throw InputError(path_.string() + ": another run is writing there");
    }
}

void OutputFolder::remove_leftovers() {
    constexpr std::string_view suffix = ".partial";
    const auto is_leftover = [&](std::string_view name) {
        if (name == preview_file) return true;
        return name.starts_with('.') && name.ends_with(suffix) && name.size() > suffix.size() + 1 &&
               is_output_name(name.substr(1, name.size() - 1 - suffix.size()));
    };
    for (const std::string& name : names_in(path_, is_leftover)) ::unlink((path_ / name).c_str());
}

void OutputFolder::discard() noexcept {
    for (const std::string& name : written_) ::unlink(partial(name).c_str());
    written_.clear();
    for (const std::string& name : shown_) ::unlink((path_ / name).c_str());
    shown_.clear();
    // Folders that are not empty stay.
    for (auto folder = created_.rbegin(); folder != created_.rend() && ::rmdir(folder->c_str()) == 0; ++folder) {
    }
    created_.clear();
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
}

void OutputFolder::write(const std::string& name, std::string_view bytes) { write_pieces(name, std::span(&bytes, 1)); }

void OutputFolder::write_pieces(const std::string& name, std::span<const std::string_view> pieces) {
    begin(name);
    end(name, write_new_file(partial(name), pieces));
}

void OutputFolder::write_by(const std::string& name, const std::function<void(const fs::path&)>& make) {
    begin(name);
    int error = write_new_file(partial(name), {});  // the file into which `make` writes
    if (error == 0) try {
            make(partial(name));
            error = flush(partial(name));
        } catch (const std::system_error& failed) {
            error = failed.code().value();
        }
    end(name, error);
}

void OutputFolder::begin(const std::string& name) {
    if (!is_output_name(name)) throw std::invalid_argument("OutputFolder: " + name + " is not a name of an output file");
    const std::scoped_lock lock(written_by_one_);
    if (std::find(written_.begin(), written_.end(), name) == written_.end()) written_.push_back(name);
}

void OutputFolder::end(const std::string& name, int error) {
    if (error == 0) return;
    ::unlink(partial(name).c_str());
    throw RunError(cannot_be_written(path_ / name, error));
}

void OutputFolder::show(const std::string& name, std::string_view bytes) {
    write(name, bytes);
    put(name);
    shown_.insert(name);
}

bool OutputFolder::may_show_page() const { return !fs::exists(path_ / "run.json") && !fs::exists(path_ / "index.html"); }

void OutputFolder::put_at_once(const std::string& name, std::span<const std::string_view> pieces) {
    write_pieces(name, pieces);
    put(name);
    ::fsync(descriptor_);
}

void OutputFolder::save(std::span<const std::string_view> pieces) {
    put_at_once(unfinished_, pieces);
    needs_saved_ = true;
}

void OutputFolder::forget() { ::unlink(saved().c_str()); }

void OutputFolder::put(const std::string& name) {
    if (::rename(partial(name).c_str(), (path_ / name).c_str()) != 0) throw RunError(cannot_be_written(path_ / name, errno));
    const std::scoped_lock lock(written_by_one_);
    std::erase(written_, name);
}

void OutputFolder::expect_space(double bytes) const {
    std::error_code unknown;
    const fs::space_info space = fs::space(path_, unknown);
    if (unknown || static_cast<double>(space.available) >= bytes) return;
    throw InputError(
        fmt::format("{}: about {} are needed there, and {} are free; take another folder, a smaller film or fewer bounces",
                    path_.string(), size_text(bytes), size_text(static_cast<double>(space.available))));
}

void OutputFolder::commit() {
    const std::vector<std::string> names = written_;
    const bool has_samples =
        needs_saved_ && ::rename((path_ / unfinished_render_file).c_str(), (path_ / samples_file).c_str()) == 0;
    const auto is_new = [&](std::string_view name) {
        return std::find(names.begin(), names.end(), name) != names.end() || (has_samples && name == samples_file) ||
               name == unfinished_run_file;
    };
    const std::string last = "run.json";

    ::unlink((path_ / last).c_str());
    for (const std::string& name : names) {
        if (name != last) put(name);
    }
    for (const std::string& stale : names_in(path_, [&](std::string_view name) { return is_output_name(name) && !is_new(name); })) {
        ::unlink((path_ / stale).c_str());
    }
    if (is_new(last)) put(last);
    ::fsync(descriptor_);
    shown_.clear();
    created_.clear();
}

std::vector<std::string> OutputFolder::add_to_others() {
    std::vector<std::string> names = written_;
    std::ranges::sort(names);
    for (const std::string& name : names) put(name);
    ::fsync(descriptor_);
    return names;
}

}  // namespace neumann

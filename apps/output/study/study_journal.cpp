#include "apps/output/study/study_journal.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/new_file.h"
#include "core/base/error.h"
#include "core/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json as_json(const StudyRun& r) {
    return {{"method", r.method},
            {"budget", r.budget},
            {"repeat", r.repeat},
            {"seed", r.seed},
            {"samples", r.samples},
            {"patches", r.patches},
            {"directions", r.directions},
            {"setup_seconds", r.setup_seconds},
            {"seconds", r.seconds},
            {"peak_memory", r.peak_memory},
            {"rays", r.rays},
            {"mean", r.mean},
            {"discretisation", r.discretisation},
            {"variance", r.variance},
            {"warnings", r.warnings}};
}

StudyRun run_of(const Json& json) {
    StudyRun r;
    json.at("method").get_to(r.method);
    json.at("budget").get_to(r.budget);
    json.at("repeat").get_to(r.repeat);
    json.at("seed").get_to(r.seed);
    json.at("samples").get_to(r.samples);
    json.at("patches").get_to(r.patches);
    json.at("directions").get_to(r.directions);
    json.at("setup_seconds").get_to(r.setup_seconds);
    json.at("seconds").get_to(r.seconds);
    json.at("peak_memory").get_to(r.peak_memory);
    json.at("rays").get_to(r.rays);
    json.at("mean").get_to(r.mean);
    json.at("discretisation").get_to(r.discretisation);
    json.at("variance").get_to(r.variance);
    json.at("warnings").get_to(r.warnings);
    return r;
}

[[noreturn]] void cannot_be_written(const fs::path& path) {
    throw RunError(fmt::format("{}: cannot be written: {}", path.string(), std::generic_category().message(errno)));
}

void write_at(int file, const char* bytes, std::size_t size, off_t at, const fs::path& path) {
    while (size > 0) {
        const ssize_t count = ::pwrite(file, bytes, size, at);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) cannot_be_written(path);
        bytes += count;
        at += count;
        size -= static_cast<std::size_t>(count);
    }
}

}  // namespace

StudyJournal::StudyJournal(const fs::path& folder, bool resume)
    : lines_path_(folder / "study.journal"), pictures_path_(folder / "study.pictures") {
    const bool exists = fs::exists(lines_path_);
    if (exists && !resume)
        throw InputError(
            fmt::format("{}: holds a study that was not finished; --resume goes on with it, and to begin another one "
                        "there, remove study.journal",
                        folder.string()));
    if (!exists && resume) throw InputError(fmt::format("{}: holds no study that could be resumed", folder.string()));
    if (exists) read();
}

StudyJournal::~StudyJournal() {
    if (lines_ >= 0) ::close(lines_);
    if (pictures_ >= 0) ::close(pictures_);
}

void StudyJournal::read() {
    std::ifstream file = open_if_there(lines_path_);
    off_t whole = 0;
    try {
        for (std::string line; std::getline(file, line) && !file.eof();) {
            const Json json = Json::parse(line);
            if (json.contains("study")) {
                study = json.at("study");
                plan = json.at("plan");
            } else {
                runs.push_back(run_of(json.at("run")));
            }
            whole += static_cast<off_t>(line.size()) + 1;
        }
    } catch (const Json::exception& e) {
        throw InputError(fmt::format("{}: damaged, and cannot be resumed: {}", lines_path_.string(), e.what()));
    }
    if (study.is_null()) throw InputError(fmt::format("{}: was cut off before anything was done", lines_path_.string()));
    lines_ = ::open(lines_path_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    if (lines_ < 0 || ::ftruncate(lines_, whole) != 0 || ::lseek(lines_, 0, SEEK_END) < 0) cannot_be_written(lines_path_);
    pictures_ = ::open(pictures_path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (pictures_ < 0) cannot_be_written(pictures_path_);
}

void StudyJournal::expect_same(const Json& now) const {
    const Json as_written = Json::parse(json_text(now));
    const auto text = [](const Json& json, const std::string& name) {
        const std::string text = json.value(name, "");
        return text.empty() ? "nothing" : text;
    };
    for (const auto& [name, value] : as_written.items())
        if (const std::string is = text(as_written, name), was = text(study, name); is != was)
            throw OptionError("resume", fmt::format(": {} is {}, and the study that was cut off has {}", name, is, was));
}

void StudyJournal::begin(const Json& new_study, const Json& new_plan) {
    study = new_study;
    plan = new_plan;
    lines_ = open_new_file(lines_path_);
    if (lines_ < 0) cannot_be_written(lines_path_);
    pictures_ = open_new_file(pictures_path_);
    if (pictures_ < 0) cannot_be_written(pictures_path_);
    append({{"study", study}, {"plan", plan}});
}

void StudyJournal::append(const Json& json) {
    const std::string line = json_text(json) + "\n";
    write_at(lines_, line.data(), line.size(), ::lseek(lines_, 0, SEEK_END), lines_path_);
}

void StudyJournal::add(const StudyRun& run, const std::vector<Image>& pictures) {
    std::vector<float> values;
    for (const Image& image : pictures)
        for (const Rgb& p : image.pixels)
            for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(p[c]));
    const std::size_t size = values.size() * sizeof(float);
    write_at(pictures_, reinterpret_cast<const char*>(values.data()), size, static_cast<off_t>(runs.size() * size), pictures_path_);
    append({{"run", as_json(run)}});
    runs.push_back(run);
}

Image StudyJournal::picture(std::size_t run, std::size_t picture, int width, int height, std::size_t pictures) const {
    Image image(width, height);
    std::vector<float> values(3 * image.pixels.size());
    const std::size_t size = values.size() * sizeof(float);
    if (::pread(pictures_, values.data(), size, static_cast<off_t>((run * pictures + picture) * size)) !=
        static_cast<ssize_t>(size))
        throw RunError(fmt::format("{}: cannot be read", pictures_path_.string()));
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = Rgb(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    return image;
}

void StudyJournal::remove() {
    fs::remove(lines_path_);
    fs::remove(pictures_path_);
}

}  // namespace neumann

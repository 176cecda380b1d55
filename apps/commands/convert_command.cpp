#include "apps/commands/convert_command.h"

#include "apps/commands/print_warnings.h"
#include "apps/output/files/new_file.h"
#include "core/base/error.h"
#include "core/reader/convert_scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <system_error>

namespace neumann {

namespace {

namespace fs = std::filesystem;

// Files that are written under other names first, and renamed when all are complete.
class NewFiles {
public:
    NewFiles() = default;
    NewFiles(const NewFiles&) = delete;
    NewFiles& operator=(const NewFiles&) = delete;
    ~NewFiles() {
        std::error_code ignored;
        for (const fs::path& path : written_) fs::remove(partial(path), ignored);
        for (const fs::path& folder : created_) fs::remove(folder, ignored);  // only those that are empty
    }

    void write(const fs::path& path, const std::string& bytes) {
        std::error_code error;
        const fs::path folder = path.parent_path();
        if (!folder.empty() && fs::create_directories(folder, error)) created_.push_back(folder);
        if (error) throw InputError(fmt::format("{}: cannot be written: {}", folder.string(), error.message()));
        written_.push_back(path);
        const std::string_view piece = bytes;
        if (const int failed = write_new_file(partial(path), {&piece, 1}); failed != 0)
            throw RunError(fmt::format("{}: cannot be written: {}", path.string(), std::generic_category().message(failed)));
    }
    void commit() {
        for (const fs::path& path : written_) {
            std::error_code error;
            fs::rename(partial(path), path, error);
            if (error) throw RunError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
        }
        written_.clear();
    }

private:
    static fs::path partial(const fs::path& path) { return path.parent_path() / ("." + path.filename().string() + ".partial"); }
    std::vector<fs::path> written_, created_;
};

}  // namespace

int convert_command(const ConvertRequest& request) {
    const fs::path output = request.output;
    std::error_code error;
    if (output.extension() != ".xml") throw InputError(fmt::format("{}: expected a name that ends in .xml", request.output));
    if (fs::is_directory(output, error)) throw InputError(fmt::format("{}: is a folder, expected a file", request.output));
    if (fs::equivalent(output, request.scene.path, error))
        throw InputError(fmt::format("{}: is the scene itself, expected another file", request.output));
    const ConvertedScene converted = convert_scene(request.scene.path, request.scene.definitions, request.scene.lenient);
    NewFiles written;
    for (const auto& [name, bytes] : converted.files) written.write(output.parent_path() / name, bytes);
    written.write(output, converted.xml);  // the last, so that the files that it names exist
    written.commit();
    const std::size_t files = converted.files.size();
    print_warnings(texts(converted.warnings), request.quiet);
    if (request.quiet) return 0;
    fmt::print("{}{}\n", request.output,
               files == 0 ? "" : fmt::format(", and {} file{} beside it in meshes and textures", files, files == 1 ? "" : "s"));
    return 0;
}

}  // namespace neumann

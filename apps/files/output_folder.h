// A folder of results whose files appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace neumann {

// Whether a file of this name is one that the program writes into an output folder: bounce_000.exr, run.json, …
bool is_output_name(std::string_view name);

// Files are written beside their places, as ".NAME.partial", and take them all in commit(). Until then what an earlier run left
// stays untouched. One process at a time writes to a folder.
class OutputFolder {
public:
    // Creates the folder, and those above it, where missing. Throws InputError where nothing can be written or another run is
    // writing: "out/x: cannot be written: Permission denied".
    // It takes the files of one command: InputError where there are another's, which commit() would remove.
    OutputFolder(const std::filesystem::path& path, std::string_view command);

    // Without commit(), leaves everything as it was found.
    ~OutputFolder();

    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    // `name` is one that is_output_name() knows; a second file of one name replaces the first. Throws RunError where not every byte
    // reaches the disk: "out/x/bounce_000.exr: cannot be written: No space left on device".
    void write(const std::string& name, std::string_view bytes);

    // Throws InputError where less than so many bytes are free: before time is spent on what cannot be written.
    void expect_space(double bytes) const;

    // Puts all files in place, run.json last, and removes the program's files of earlier runs that are not among them. A folder
    // that holds pictures and no run.json is one where this was cut off.
    void commit();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path partial(const std::string& name) const { return path_ / ("." + name + ".partial"); }
    void expect_no_other_files(std::string_view command) const;
    void create();
    void lock();
    void remove_leftovers();
    void discard() noexcept;

    std::filesystem::path path_;
    std::vector<std::filesystem::path> created_;  // folders that were missing, outermost first
    std::vector<std::string> written_;
    int descriptor_ = -1;  // of the folder: holds the lock
};

}  // namespace neumann

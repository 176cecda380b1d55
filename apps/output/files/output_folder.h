// An output folder whose files are written atomically.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace neumann {

// Files with the state of an unfinished render, of a finished render (saved_render.h), and of a study's unfinished run.
inline const std::string unfinished_render_file = "render.unfinished", samples_file = "render.samples",
                         unfinished_run_file = "study.unfinished";

// Whether the program writes files of this name into an output folder: bounce_000.exr, run.json, …
bool is_output_name(std::string_view name);

// Files are written as ".NAME.partial" and renamed in commit(). Until then the files of an earlier run stay unchanged. Only one
// process at a time writes to a folder.
class OutputFolder {
public:
    // Creates the folder, and those above it, if they are missing. Throws InputError if the folder cannot be written or
    // another run is writing to it ("out/x: cannot be written: Permission denied"), and if it holds files of another
    // command, which commit() would remove. `locks`: false if another process of the same run locks it.
    OutputFolder(const std::filesystem::path& path, std::string_view command, bool locks = true);

    // Without commit(), restores everything as it was.
    ~OutputFolder();

    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    // is_output_name(name) must be true; a second file of the same name replaces the first. May be called from several threads, for
    // several files. Throws RunError if not all bytes can be written: "out/x/bounce_000.exr: cannot be written: No space left on
    // device".
    void write(const std::string& name, std::string_view bytes);
    // As write(), for a file that would be large in memory: `make` writes it to the path that it is given. Its
    // std::system_error becomes a RunError.
    void write_by(const std::string& name, const std::function<void(const std::filesystem::path&)>& make);

    // Puts preview.png or index.html of an unfinished run in place at once. commit() and the destructor remove it; if
    // the process was killed, the next run removes preview.png. The index.html of a finished run must not be replaced
    // in this way (may_show_page()). Throws as write().
    void show(const std::string& name, std::string_view bytes);
    bool may_show_page() const;

    // Puts a file made of these pieces in place at once; it stays. Throws as write().
    void put_at_once(const std::string& name, std::span<const std::string_view> pieces);

    // Puts render.unfinished, or study.unfinished in a study's folder, in place at once, made of these pieces; another
    // process can make the pictures from it if this one does not. It stays until commit(), which renames it to
    // render.samples, or removes it if has_all_of_saved() was called after the last save(); or until forget(). If not
    // all bytes can be written, the previous one is unchanged. Throws as write().
    void save(std::span<const std::string_view> pieces);
    void has_all_of_saved() { needs_saved_ = false; }
    std::filesystem::path saved() const { return path_ / unfinished_; }
    void forget();

    // Throws InputError if fewer bytes are free, before time is spent on results that cannot be written.
    void expect_space(double bytes) const;

    // Puts all files in place, run.json last, and removes the program's files of earlier runs that are not among them. If a folder
    // has pictures but no run.json, commit() was interrupted.
    void commit();

    // Puts all files in place beside those of the earlier run that is there, and returns their names in order.
    std::vector<std::string> add_to_others();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path partial(const std::string& name) const { return path_ / ("." + name + ".partial"); }
    void write_pieces(const std::string& name, std::span<const std::string_view> pieces);
    void begin(const std::string& name);
    void end(const std::string& name, int error);  // `error`: 0, or its number
    void put(const std::string& name);
    void expect_no_other_files(std::string_view command) const;
    void create();
    void open();
    void lock();
    void remove_leftovers();
    void discard() noexcept;

    std::filesystem::path path_;
    std::string unfinished_;
    bool needs_saved_ = true;
    std::vector<std::filesystem::path> created_;  // folders that were missing, outermost first
    std::mutex written_by_one_;
    std::vector<std::string> written_;
    std::set<std::string> shown_;
    int descriptor_ = -1;  // the folder's; it holds the lock
};

}  // namespace neumann

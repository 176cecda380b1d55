// The journal of a study on disk, so that an interrupted study can be resumed.
//
//     study.journal   lines of JSON: the study, its plan, and then one line for each finished run
//     study.pictures  the pictures of the runs, one after the other, float32
//
// Both are appended to, pictures first; an incomplete last line is ignored. There is no fsync, which would take longer
// than short runs: nothing is lost if the program is killed, but something may be if the machine fails.
#pragma once

#include "apps/output/study/study_data.h"

#include <filesystem>

namespace neumann {

class StudyJournal {
public:
    // The folder must exist. Throws InputError if it has a journal and `resume` is false, or has none and `resume` is true.
    StudyJournal(const std::filesystem::path& folder, bool resume);
    ~StudyJournal();
    StudyJournal(const StudyJournal&) = delete;
    StudyJournal& operator=(const StudyJournal&) = delete;

    // The study, as texts by name, and its plan; null for a new journal.
    nlohmann::ordered_json study, plan;
    // Throws InputError that names the differences, if `study` is not the study of the journal.
    void expect_same(const nlohmann::ordered_json& study) const;

    void begin(const nlohmann::ordered_json& study, const nlohmann::ordered_json& plan);
    std::vector<StudyRun> runs;

    // `pictures`: all bounces and the sum.
    void add(const StudyRun& run, const std::vector<Image>& pictures);
    Image picture(std::size_t run, std::size_t picture, int width, int height, std::size_t pictures) const;
    // Removes the journal after the study is finished and its results are written.
    void remove();

private:
    void append(const nlohmann::ordered_json& line);
    void read();

    std::filesystem::path lines_path_, pictures_path_;
    int lines_ = -1, pictures_ = -1;
};

}  // namespace neumann

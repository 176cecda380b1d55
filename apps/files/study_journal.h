// What a study has done, on disk as it goes on, so that one that is cut off can be resumed.
//
//     study.journal   a line of JSON each: what is studied and how it was planned, then every run as it ends
//     study.pictures  the pictures of the runs, one after the other, float32
//
// Both are appended to, pictures first; a last line that is cut off is not taken. Neither is forced to the disk, which would take
// longer than short runs: a program that is killed loses nothing, a machine that fails may.
#pragma once

#include "apps/commands/study_data.h"

#include <filesystem>

namespace neumann {

class StudyJournal {
public:
    // In a folder that exists. Throws InputError where there is one and it is not to be resumed, or none although it is.
    StudyJournal(const std::filesystem::path& folder, bool resume);
    ~StudyJournal();
    StudyJournal(const StudyJournal&) = delete;
    StudyJournal& operator=(const StudyJournal&) = delete;

    // What was studied, and how it was planned; null where nothing was begun.
    nlohmann::ordered_json study, plan;
    // Throws InputError that names what is not as it was.
    void expect_same(const nlohmann::ordered_json& study) const;

    void begin(const nlohmann::ordered_json& study, const nlohmann::ordered_json& plan);
    // In their order.
    std::vector<StudyRun> runs;

    // `pictures`: of all bounces and the sum.
    void add(const StudyRun& run, const std::vector<Image>& pictures);
    Image picture(std::size_t run, std::size_t picture, int width, int height, std::size_t pictures) const;
    // All is done and written elsewhere.
    void remove();

private:
    void append(const nlohmann::ordered_json& line);
    void read();

    std::filesystem::path lines_path_, pictures_path_;
    int lines_ = -1, pictures_ = -1;
};

}  // namespace neumann

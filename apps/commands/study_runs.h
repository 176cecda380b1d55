// Makes the runs of a study, and evaluates their pictures.
#pragma once

#include "apps/files/study_journal.h"

namespace neumann {

// Throws InputError if the pictures of all runs, which are kept until the end, do not fit into the folder.
void expect_disk_space(const StudyData& data, const std::filesystem::path& folder);

// Goes on until everything is done or it is interrupted. The outer loop is over repeats, so that other load on the machine affects
// all methods and budgets alike, and an interrupted study has some runs of each.
void run_all(StudyData& data, StudyJournal& journal, const StudyStatus& status);

// Evaluates all points with at least two repeats.
std::vector<StudyPoint> judge(const StudyData& data, const StudyJournal& journal);

}  // namespace neumann

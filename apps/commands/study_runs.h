// The runs of a study, one by one, and what their pictures say together.
#pragma once

#include "apps/files/study_journal.h"

namespace neumann {

// Throws InputError where the pictures of all runs, which are kept until the end, do not fit there.
void expect_disk_space(const StudyData& data, const std::filesystem::path& folder);

// Goes on until everything is done or it is interrupted. Repeat after repeat, so that what else the machine does meets all methods
// and budgets alike, and so that a study that is cut off has something of everything.
void run_all(StudyData& data, StudyJournal& journal, const StudyStatus& status);

// All points of at least two repeats.
std::vector<StudyPoint> judge(const StudyData& data, const StudyJournal& journal);

}  // namespace neumann

// Makes the runs of a study, and keeps them in its journal.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/output/study/study_journal.h"

namespace neumann {

// Throws InputError if the pictures of all runs, which are kept until the end, do not fit into the folder.
void expect_disk_space(const StudyData& data, const std::filesystem::path& folder);

// Goes on until all is done or it is interrupted. The state of a long unfinished run is in the folder.
void run_all(StudyData& data, StudyJournal& journal, OutputFolder& folder, const StudyStatus& status);

}  // namespace neumann

// index.html of an unfinished render, to look at and reload.
#pragma once

#include "apps/live/viewer.h"
#include "apps/output/files/output_folder.h"

namespace neumann {

class PageSoFar : public Viewer {
public:
    // Keeps a reference to the folder.
    explicit PageSoFar(OutputFolder& folder) : folder_(folder) {}

    // Failures to write are ignored.
    void see(const Rendering& so_far) override;

    // Approximate seconds for the first page, with this number of pictures of this number of pixels.
    static double expected_seconds(double pixels, double pictures) { return 3e-7 * pixels * pictures; }

private:
    OutputFolder& folder_;
};

}  // namespace neumann

// index.html of a render that is under way, to be looked at and loaded anew.
#pragma once

#include "apps/live/viewer.h"
#include "apps/output/files/output_folder.h"

namespace neumann {

class PageSoFar : public Viewer {
public:
    // Keeps a reference to the folder.
    explicit PageSoFar(OutputFolder& folder) : folder_(folder) {}

    // What cannot be written is not missed.
    void see(const Rendering& so_far) override;

    // About what the first one takes, in seconds, for so many pictures of so many pixels.
    static double expected_seconds(double pixels, double pictures) { return 3e-7 * pixels * pictures; }

private:
    OutputFolder& folder_;
};

}  // namespace neumann

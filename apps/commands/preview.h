// preview.png of an unfinished render: the strip of the terms so far, whose noise is smoothed.
#pragma once

#include "apps/live/viewer.h"
#include "apps/output/files/output_folder.h"
#include "core/image/image.h"

#include <atomic>
#include <functional>
#include <string>
#include <utility>

namespace neumann {

class Preview {
public:
    // Keeps a reference to the folder. `kind` is appended to labels, such as ", lenient"; `seen` gets the bytes of each, too.
    Preview(OutputFolder& folder, std::string kind, std::function<void(std::string)> seen)
        : folder_(folder), kind_(std::move(kind)), seen_(std::move(seen)) {}

    // A function for Watch::show. It skips calls that come too soon, to take little time, and ignores failures to write.
    void show(std::size_t bounces, const std::function<Image(std::size_t)>& term);
    // May be called from any thread.
    bool is_there() const { return is_there_; }

private:
    void write(std::size_t bounces, const std::function<Image(std::size_t)>& term);

    OutputFolder& folder_;
    std::string kind_;
    std::function<void(std::string)> seen_;
    std::atomic<bool> is_there_ = false;
    SmallShare share_{50};
};

}  // namespace neumann

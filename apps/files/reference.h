// The pictures of an earlier render, to judge another one by.
#pragma once

#include "apps/files/rendered_picture.h"
#include "core/base/warnings.h"
#include "operators/methods/bounce_series.h"

#include <string>
#include <vector>

namespace neumann {

class Reference {
public:
    // Bounces 0 … N and their sum. Throws InputError.
    Reference(const std::string& folder, int bounces, const Film& film);
    // Watch::judge.
    void judge(const std::function<Image(std::size_t)>& term, const Image& sum, Checkpoint& checkpoint) const;

private:
    std::vector<Image> terms_;
    Image sum_;
};

// A picture of an earlier render, of the size of this film. Throws InputError.
RenderedPicture read_reference(const std::string& folder, const std::string& file, const Film& film);

// What makes the reference of no use for this series, by what its run.json says, where it has one.
void warn_of_reference(const std::string& folder, const BounceSeries& series, Warnings& warnings);

}  // namespace neumann

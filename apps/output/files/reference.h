// The pictures of an earlier render, used as the reference of another one.
#pragma once

#include "apps/output/files/rendered_picture.h"
#include "core/base/warnings.h"
#include "operators/render/methods/bounce_series.h"

#include <string>
#include <vector>

namespace neumann {

class Reference {
public:
    // Reads bounces 0 … N and their sum. Throws InputError.
    Reference(const std::string& folder, int bounces, const Film& film);
    // The function for Watch::judge.
    void judge(const std::function<Image(std::size_t)>& term, const Image& sum, Checkpoint& checkpoint) const;

private:
    std::vector<Image> terms_;
    Image sum_;
};

// Reads a picture of an earlier render. Throws InputError also if its size is not that of the film.
RenderedPicture read_reference(const std::string& folder, const std::string& file, const Film& film);

// Warns if the reference is of no use for this series, according to its run.json (if there is one).
void warn_of_reference(const std::string& folder, const BounceSeries& series, Warnings& warnings);

}  // namespace neumann

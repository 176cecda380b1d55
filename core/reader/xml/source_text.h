// The text of an XML file, for converting offsets to line and column.
#pragma once

#include "core/base/error.h"

#include <string>
#include <string_view>
#include <vector>

namespace neumann::reader {

class SourceText {
public:
    // Throws InputError if the file cannot be read.
    explicit SourceText(const std::string& path);

    const std::string& text() const { return text_; }
    Location place(std::size_t offset) const;
    // The offset of a place in this text; its end if there is no such line.
    std::size_t offset(const Location& place) const;
    // The place of the index-th attribute of the element whose name begins at `offset`.
    Location attribute_place(std::size_t offset, int index) const;

private:
    std::string path_, text_;
    std::vector<std::size_t> line_starts_;
};

}  // namespace neumann::reader

#include "core/reader/xml/source_text.h"

#include "core/base/input_file.h"

#include <algorithm>

namespace neumann::reader {

SourceText::SourceText(const std::string& path) : path_(path), text_(read_input(path, "a scene file")), line_starts_{0} {
    const Location file{path, 0, 0};
    if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) throw InputError(file, "is in UTF-16, expected UTF-8");
    for (std::size_t i = text_.find('\n'); i != std::string::npos; i = text_.find('\n', i + 1)) line_starts_.push_back(i + 1);
}

Location SourceText::place(std::size_t offset) const {
    const auto line = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset) - 1;
    return {path_, static_cast<int>(line - line_starts_.begin()) + 1, static_cast<int>(offset - *line) + 1};
}

std::size_t SourceText::offset(const Location& place) const {
    if (place.line < 1 || static_cast<std::size_t>(place.line) > line_starts_.size()) return text_.size();
    const std::size_t column = static_cast<std::size_t>(std::max(place.column, 1)) - 1;
    return std::min(line_starts_[static_cast<std::size_t>(place.line) - 1] + column, text_.size());
}

Location SourceText::attribute_place(std::size_t offset, int index) const {
    constexpr std::string_view blanks = " \t\r\n";
    std::size_t at = text_.find_first_of(blanks, offset);
    for (int i = 0;; ++i) {
        at = text_.find_first_not_of(blanks, at);
        if (at >= text_.size()) return place(offset);
        if (i == index) return place(at);
        const std::size_t quote = text_.find_first_of("\"'", at);
        if (quote == std::string::npos) return place(offset);
        at = text_.find(text_[quote], quote + 1);
        if (at == std::string::npos) return place(offset);
        ++at;
    }
}

}  // namespace neumann::reader

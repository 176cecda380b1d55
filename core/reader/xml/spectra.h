// <spectrum>: a value, a list wavelength:value, a file of such a list, or an object: `blackbody`, `d65`, `irregular`, `regular`,
// `uniform`.
#pragma once

#include "core/reader/xml/document.h"

namespace neumann::reader {

// Replaces a spectrum given by a file or an object by its list or number, so that later code needs to handle <spectrum name value>
// and <float name value> only. A list that comes from `blackbody` keeps its type.
// A lenient reader takes a type that is unknown as 0.5, and as 0 in an emitter.
void write_out_spectrum(Element& e, const std::string& parent_tag, Document& document, Problems& problems);

}  // namespace neumann::reader

// <spectrum>: a value, a list wavelength:value, a file of such a list, or an object: `blackbody`, `d65`, `irregular`, `regular`,
// `uniform`.
#pragma once

#include "core/reader/xml/document.h"

namespace neumann::reader {

// Makes the list or the number of a file or an object, as if it stood in the scene: what comes after knows <spectrum name value>
// and <float name value> only. A list that comes from `blackbody` keeps its type.
void write_out_spectrum(Element& e, Document& document, Problems& problems);

}  // namespace neumann::reader

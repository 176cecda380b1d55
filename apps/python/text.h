// Text in Python and in C++. Names of files need not be UTF-8, and any text may contain one (an error, a warning, a
// command line): other bytes become lone surrogates in Python and bytes again here, as in os.fsdecode and os.fsencode.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

template <>
struct pybind11::detail::type_caster<std::string> {
    PYBIND11_TYPE_CASTER(std::string, const_name("str"));

    bool load(handle given, bool) {
        if (PyUnicode_Check(given.ptr())) {
            const auto bytes = reinterpret_steal<object>(PyUnicode_AsEncodedString(given.ptr(), "utf-8", "surrogateescape"));
            if (bytes) return load(bytes, false);
            PyErr_Clear();
            return false;
        }
        if (!PyBytes_Check(given.ptr())) return false;
        value.assign(PyBytes_AS_STRING(given.ptr()), static_cast<std::size_t>(PyBytes_GET_SIZE(given.ptr())));
        return true;
    }

    static handle cast(const std::string& text, return_value_policy, handle) {
        const handle made = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape");
        if (!made) throw error_already_set();
        return made;
    }
};

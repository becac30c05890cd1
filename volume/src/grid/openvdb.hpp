#pragma once

// OpenVDB keeps the name of each tree type in a static that it fills under std::call_once. With the
// project's hidden visibility the statics of our copy would be our own, but the function that fills
// them, a template of std, would still take the place of OpenVDB's: openvdb::initialize() then
// reads a name that was never filled, and crashes. So everything from this header stays visible;
// what of it lands in the library is kept inside by cmake/exports.map, template and statics
// together.
#pragma GCC visibility push(default)
#include <openvdb/openvdb.h>
#pragma GCC visibility pop

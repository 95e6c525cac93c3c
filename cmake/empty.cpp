// SPDX-License-Identifier: MIT
// Carries the precompiled headers of CMakeLists.txt; CMake makes them only for a target with a source.

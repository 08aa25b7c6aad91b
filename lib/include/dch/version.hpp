// SPDX-License-Identifier: MIT
#pragma once

// The version of the library that a program was compiled with. CMake checks that it is that of the project.
#define DCH_VERSION_MAJOR 0
#define DCH_VERSION_MINOR 1
#define DCH_VERSION_PATCH 0
#define DCH_VERSION "0.1.0"

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "city/source_model.h"

namespace ridgeline {

// The surfaces of one building at one level of detail as bytes: a version, then per polygon its
// class and rings, with coordinates as doubles; little endian.
std::vector<std::uint8_t> EncodeBuilding(const SourceModel& model,
                                         const SourceBuilding& building,
                                         int lod);

// Appends the surfaces to `model` as members of `building`. Throws InputError(file, id, ...) for
// bytes that are damaged.
void DecodeBuilding(std::span<const std::uint8_t> bytes,
                    const std::string& file,
                    SourceModel& model,
                    SourceBuilding& building);

}  // namespace ridgeline

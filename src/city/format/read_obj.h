// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "city/format/input_file.h"
#include "city/source_model.h"

namespace ridgeline {

// Reads a Wavefront OBJ file: v and f lines; o (else g) lines name buildings; group and material
// names that hold "roof", "wall", "ground" give classes. See MeshSource for its place in the world.
// Throws InputError with the line for numbers that are none and for indices out of range.
SourceModel ReadObj(InputFile& file);

// Reads a PLY file (ascii, binary_little_endian, binary_big_endian) with x, y, z of its vertices
// and the vertex lists of its faces. Throws InputError for anything else.
SourceModel ReadPly(InputFile& file);

}  // namespace ridgeline

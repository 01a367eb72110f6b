// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/options.h"

namespace ridgeline {

// How buildings become a mesh with edges.
struct MeshOptions {
  // Level of detail wanted, 1 to 4. A building without it is read in its next one, with a warning.
  int lod = 2;
  // Feature edges: smallest angle between the normals of the two faces [deg].
  double min_dihedral_deg = 10.0;
  // Vertices closer than this are one [m].
  double weld_m = 0.005;
  // Faces and edges closer than this touch, e.g. the walls that adjoining buildings share [m].
  double adjoin_m = 0.05;
  // A corner where the facade goes on in another building's, no farther than this in front of it or
  // behind it, is a seam [m]; 0: only corners without any step are.
  double joint_m = 0.35;
  // Threads; 0: all.
  int threads = 0;

  void Visit(OptionVisitor& v) {
    v.Field("lod", lod, Closed(1, 4));
    v.Field("min_dihedral_deg", min_dihedral_deg, Closed(0.1, 170.0));
    v.Field("weld_m", weld_m, Closed(1e-6, 0.5));
    v.Field("adjoin_m", adjoin_m, Closed(1e-3, 1.0));
    v.Field("joint_m", joint_m, Closed(0.0, 2.0));
    v.Field("threads", threads, Closed(0, 4096));
  }
};

}  // namespace ridgeline

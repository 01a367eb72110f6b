// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "augment/textured_mesh.h"
#include "projection/scene.h"
#include "replay/ayadi_replay.h"
#include "replay/replay_page.h"

namespace ridgeline {

// Results of one variant over a sequence, as many as frames.
struct AyadiRun {
  AyadiVariant variant;
  std::vector<AyadiResult> frames;
};

// Table 1 with the paper's rows, Fig. 11 (both kinds of L1), frames.csv.
void AddAyadiResults(std::span<const AyadiRun> runs, ReplayPage& page);

// Error and jitter of a building inserted by each method, where the truth is known, and by the
// temporal way (from the last frame, key frames in six degrees of freedom).
struct AyadiTemporal {
  std::vector<std::optional<Pose>> poses;  // cam_from_local, by frame
};
void AddAyadiStability(std::span<const AyadiRun> runs,
                       std::span<const AyadiFrame> frames,
                       const AyadiTemporal& temporal,
                       const TexturedMesh& tower,
                       ReplayPage& page);

// Sizes of the skylines of all frames by precision, as extracted by the first variant.
void AddAyadiSizes(std::span<const AyadiRun> runs, ReplayPage& page);

// Of one frame by one variant: Fig. 8 (simplification), Fig. 10 (skylines before and after each
// method), Fig. 12 (real picture and virtual ones), and, with `tower`, Fig. 13 (augmented pictures by
// instruments and by 3D).
void AddAyadiFrame(const Scene& scene,
                   const AyadiVariant& variant,
                   const AyadiFrame& frame,
                   const AyadiResult& result,
                   const TexturedMesh* tower,
                   ReplayPage& page);

// Fig. 9.
void AddAyadiDomain(const AyadiDomain& domain,
                    const AyadiFrame& frame,
                    const std::string& variant,
                    ReplayPage& page);

// A tower of 14 x 14 x 45 m at a distance before a camera, where no building is given: in the local
// frame, on the height given.
CityModel TowerBefore(const Pose& cam_from_local, double distance_m, double ground_height_m);

}  // namespace ridgeline

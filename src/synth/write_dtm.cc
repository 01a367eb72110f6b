// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/gdal_handles.h"
#include "synth/write_city.h"

namespace ridgeline {
void WriteDtm(const Town& town, const HeightGrid& grid, const std::filesystem::path& path) {
  GDALAllRegister();
  const std::filesystem::path temporary = TemporaryBeside(path);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const std::array<const char*, 4> creation = {
      "COMPRESS=DEFLATE", "PREDICTOR=3", "TILED=YES", nullptr};
  GdalDatasetPtr dataset(driver->Create(temporary.c_str(),
                                        grid.columns,
                                        grid.rows,
                                        1,
                                        GDT_Float32,
                                        const_cast<char**>(creation.data())));
  if (!dataset) throw InputError(path.string(), "", CPLGetLastErrorMsg(), "a writable GeoTIFF");

  const double top = grid.first.y() + (grid.rows - 1) * grid.spacing_m;
  std::array<double, 6> transform = {
      town.origin_in_world.x() + grid.first.x() - 0.5 * grid.spacing_m,
      grid.spacing_m,
      0.0,
      town.origin_in_world.y() + top + 0.5 * grid.spacing_m,
      0.0,
      -grid.spacing_m};
  OGRSpatialReference crs;
  crs.importFromEPSG(town.epsg);
  dataset->SetGeoTransform(transform.data());
  dataset->SetSpatialRef(&crs);

  std::vector<float> row(static_cast<std::size_t>(grid.columns));
  CPLErr status = CE_None;
  for (int r = 0; r < grid.rows && status == CE_None; ++r) {
    const std::size_t first = static_cast<std::size_t>(grid.rows - 1 - r) * grid.columns;
    for (int c = 0; c < grid.columns; ++c) {
      row[c] = static_cast<float>(grid.heights[first + c] + town.origin_in_world.z());
    }
    status = dataset->GetRasterBand(1)->RasterIO(
        GF_Write, 0, r, grid.columns, 1, row.data(), grid.columns, 1, GDT_Float32, 0, 0);
  }
  dataset->GetRasterBand(1)->SetNoDataValue(-9999.0);
  dataset.reset();
  if (status != CE_None) throw InputError(path.string(), "", CPLGetLastErrorMsg(), "free space");
  CommitFile(temporary, path);
}

}  // namespace ridgeline

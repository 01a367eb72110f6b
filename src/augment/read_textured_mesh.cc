// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <assimp/GltfMaterial.h>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "augment/textured_mesh.h"
#include "base/error.h"
#include "camera/decode_file.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

std::string LowerExtension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return extension;
}

// A texture inside of the file: compressed, or plain BGRA texels.
cv::Mat Embedded(const aiTexture& texture) {
  if (texture.mHeight == 0) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(texture.pcData);
    return cv::imdecode(std::vector<unsigned char>(bytes, bytes + texture.mWidth),
                        cv::IMREAD_UNCHANGED);
  }
  const cv::Mat texels(static_cast<int>(texture.mHeight),
                       static_cast<int>(texture.mWidth),
                       CV_8UC4,
                       texture.pcData);
  return texels.clone();
}

// 8 bits and three or four channels, or nothing.
cv::Mat Usable(const cv::Mat& picture) {
  if (picture.empty() || picture.depth() != CV_8U) return {};
  if (picture.channels() >= 3) return picture;
  cv::Mat colour;
  cv::merge(std::vector<cv::Mat>(3, picture), colour);
  return colour;
}

cv::Mat TextureOf(const aiScene& scene,
                  const aiMaterial& material,
                  const fs::path& folder,
                  std::vector<std::string>& warnings) {
  aiString name;
  bool found = false;
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    found = found || material.GetTexture(type, 0, &name) == AI_SUCCESS;
    if (found) break;
  }
  if (!found) return {};
  if (const aiTexture* const inside = scene.GetEmbeddedTexture(name.C_Str())) {
    const cv::Mat texture = Usable(Embedded(*inside));
    if (texture.empty()) warnings.push_back("an embedded texture cannot be read");
    return texture;
  }
  // Names of files are data from outside: nothing above the model's folder is read.
  std::string relative = name.C_Str();
  std::replace(relative.begin(), relative.end(), '\\', '/');
  const fs::path file = (folder / relative).lexically_normal();
  const fs::path below = file.lexically_relative(folder.lexically_normal());
  if (fs::path(relative).is_absolute() || below.empty() || *below.begin() == "..") {
    warnings.push_back("texture " + relative + " is not below the model's folder: left out");
    return {};
  }
  std::error_code error;
  cv::Mat texture;
  if (fs::is_regular_file(file, error)) {
    texture = Usable(DecodeFile(file, cv::IMREAD_UNCHANGED, "a texture"));
  }
  if (texture.empty()) warnings.push_back("texture " + relative + " cannot be read: left out");
  return texture;
}

MeshMaterial MaterialOf(const aiScene& scene,
                        const aiMaterial& from,
                        const fs::path& folder,
                        std::vector<std::string>& warnings) {
  MeshMaterial material;
  material.name = from.GetName().C_Str();
  aiColor4D colour;
  if (aiGetMaterialColor(&from, AI_MATKEY_BASE_COLOR, &colour) == AI_SUCCESS ||
      aiGetMaterialColor(&from, AI_MATKEY_COLOR_DIFFUSE, &colour) == AI_SUCCESS) {
    material.bgr = cv::Vec3f(colour.b, colour.g, colour.r) * 255.0f;
    material.opacity = std::clamp(colour.a, 0.0f, 1.0f);
  }
  float opacity = 1.0f;
  if (from.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS) {
    material.opacity = std::min(material.opacity, std::clamp(opacity, 0.0f, 1.0f));
  }
  // glTF's alpha counts in materials that say so only.
  aiString mode;
  if (from.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == AI_SUCCESS &&
      std::string(mode.C_Str()) == "OPAQUE") {
    material.opacity = 1.0f;
  }
  material.texture = TextureOf(scene, from, folder, warnings);
  return material;
}

void AddMesh(const aiMesh& from, bool y_up, TexturedMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    const aiVector3D& v = from.mVertices[i];
    // x stays east; what was towards the viewer is south.
    mesh.vertices.push_back(y_up ? Eigen::Vector3d(v.x, -v.z, v.y) : Eigen::Vector3d(v.x, v.y, v.z));
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    TexturedMesh::Face added;
    added.material = from.mMaterialIndex;
    for (std::size_t k = 0; k < 3; ++k) {
      added.vertices[k] = first + face.mIndices[k];
      if (!from.HasTextureCoords(0)) continue;
      const aiVector3D& uv = from.mTextureCoords[0][face.mIndices[k]];
      added.uv[k] = {uv.x, uv.y};
    }
    mesh.faces.push_back(added);
  }
}

}  // namespace

bool IsTexturedFormat(const fs::path& path) {
  static const std::vector<std::string> known = {
      ".gltf", ".glb", ".obj", ".dae", ".fbx", ".3ds", ".ply", ".stl"};
  return std::find(known.begin(), known.end(), LowerExtension(path)) != known.end();
}

namespace {

// assimp makes room for what a binary glTF says that it holds.
void CheckLengthOfGlb(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<unsigned char, 16> head{};
  stream.read(reinterpret_cast<char*>(head.data()), head.size());
  const auto number = [&head](std::size_t at) {
    return head[at] | head[at + 1] << 8 | head[at + 2] << 16 |
           static_cast<std::uint64_t>(head[at + 3]) << 24;
  };
  const std::uint64_t size = fs::file_size(path);
  if (number(8) <= size && number(12) <= size) return;
  throw InputError(path.string(),
                   "header",
                   "the length " + std::to_string(std::max(number(8), number(12))) +
                       " in a file of " + std::to_string(size) + " bytes",
                   "a whole file (was the copy cut off?)");
}

}  // namespace

TexturedMesh ReadTexturedMesh(const fs::path& path, bool y_up) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw InputError(path.string(), "", "nothing", "a model (glTF, GLB, OBJ, ...)");
  }
  if (LowerExtension(path) == ".glb") CheckLengthOfGlb(path);
  Assimp::Importer importer;
  // Nodes' transforms are applied, so that one list of triangles is left.
  const aiScene* const scene =
      importer.ReadFile(path.string(),
                        aiProcess_Triangulate | aiProcess_PreTransformVertices |
                            aiProcess_SortByPType | aiProcess_FindDegenerates);
  if (scene == nullptr) {
    throw InputError(
        path.string(), "", importer.GetErrorString(), "a model that assimp can read");
  }
  const std::string extension = LowerExtension(path);
  const bool is_gltf = extension == ".gltf" || extension == ".glb";
  TexturedMesh mesh;
  const fs::path folder = fs::absolute(path).parent_path();
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
    mesh.materials.push_back(MaterialOf(*scene, *scene->mMaterials[i], folder, mesh.warnings));
  }
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    AddMesh(*scene->mMeshes[i], y_up || is_gltf, mesh);
  }
  if (mesh.faces.empty()) throw InputError(path.string(), "", "no triangles", "a model with faces");
  constexpr double kExactM = 50000.0;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    if (!v.allFinite()) {
      throw InputError(path.string(), "", "a coordinate that is not finite", "numbers");
    }
    if (v.cwiseAbs().maxCoeff() < kExactM) continue;
    mesh.warnings.push_back(
        "coordinates are far from zero, where this format keeps centimetres only: place the model "
        "by --place instead");
    break;
  }
  return mesh;
}

}  // namespace ridgeline

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geometry/polygon.hpp"

/// What a file of another program holds, in terms that every format has: the one model between the readers
/// and what cleans it up and writes it.
namespace dim {

/// A material as the other program states it, all values without colour (luminous), 0 to 1.
struct ImportedMaterial {
  std::string name;
  /// Reflected in all directions, of what the specular part leaves (as `diffuse` of a zone file); nothing:
  /// not stated.
  std::optional<double> diffuse;
  double assumed = 0.5;                        ///< what is taken for `diffuse` where it is not stated
  double specular = 0.0;                       ///< k_s
  double roughness = 0.0;                      ///< RMS slope
  std::optional<double> specular_reflectance;  ///< at every angle, in place of Fresnel's law of index 1.5
  bool is_glass = false;                       ///< a glazing, even if its transmittance is not stated
  std::optional<double> transmittance;         ///< of a glazing, at normal incidence
  double ior = 1.52;                           ///< of a glazing
  bool scattering = false;                     ///< a glazing that scatters what it lets through
  double direct = 0.0;                         ///< of a scattering one: the part that goes straight on
  std::optional<double> luminance_cd_m2;       ///< of a light: what is made of it is a luminaire, no surface
};

/// What a reader knows of the side that a face is lit from.
enum class Lit : std::uint8_t {
  unknown,        ///< decided by what the face encloses
  front,          ///< as its corners run: counter-clockwise seen from the lit side
  both,           ///< a thin sheet
  outside,        ///< of an external obstruction, `front` seen from its lit side
  outside_sheet,  ///< both sides of one
  open            ///< nothing is there: counts for a room's volume alone
};

struct ImportedFace {
  Ring3 outline;             ///< may run to and fro along one edge to a hole inside it (seams)
  std::vector<Ring3> holes;  ///< either way round
  int material = 0;          ///< index into ImportedModel::materials
  std::string name;  ///< of the object that it belongs to; faces of one name may be merged; may be empty
  std::string room;  ///< that it bounds, where the format knows rooms
  std::string on;    ///< name of the face that this is cut out of (a window)
  Lit lit = Lit::unknown;
};

struct ImportedLuminaire {
  std::string name;
  std::string photometry;  ///< path of its photometric file; empty: ideal, Lambertian
  double lumens = 0.0;     ///< of an ideal one, if the unit is a metre: grows with its square
  Vec3 at{0.0};
  Vec3 aim{0, 0, -1};
  std::optional<Vec3> c0;
  std::optional<std::array<double, 2>> opening;  ///< along c0, across it
  double factor = 1.0;                           ///< on the flux
};

/// A file that the model carries inside itself, to be written beside the lights file.
struct ImportedFile {
  std::string name, bytes;
};

struct ImportedSensors {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  ///< [positions]
};

enum class UpAxis : std::uint8_t { y, z };

struct ImportedModel {
  std::string format;  ///< "OBJ", "Radiance", … for the summary
  std::vector<ImportedMaterial> materials;
  std::vector<ImportedFace> faces;
  std::vector<ImportedLuminaire> luminaires;
  std::vector<ImportedFile> files;
  std::vector<ImportedSensors> sensors;
  std::optional<double> unit_m;  ///< length of one unit, where the file or the format states it
  UpAxis up = UpAxis::z;
  bool up_stated = false;         ///< by the file or the format
  bool single_precision = false;  ///< coordinates have no more than 24 bits
  Warnings warnings;              ///< what is not understood, by name
};

/// Index of the material of that name, added without properties where there is none yet.
int material_named(ImportedModel& model, const std::string& name);

/// Reflectance or transmittance of linear RGB: luminance of BT.709 primaries.
inline double luminous(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/// Most faces, corners and materials that are read.
inline constexpr std::size_t kMaxImportedFaces = 5'000'000;
inline constexpr std::size_t kMaxImportedCorners = 20'000'000;

}  // namespace dim

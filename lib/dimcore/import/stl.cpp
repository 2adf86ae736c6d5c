#include "import/stl.hpp"

#include <fmt/format.h>

#include "import/byte_reader.hpp"
#include "import/token_line.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

constexpr std::size_t kHeader = 80, kTriangle = 50;

ImportedModel empty_model(const std::string& format) {
  ImportedModel model;
  model.format = format;
  material_named(model, "");
  return model;
}

/// Binary files may begin with "solid", too: it is the length that tells.
bool is_binary(std::string_view bytes) {
  if (bytes.size() < kHeader + 4) return false;
  const auto n = number_at<std::uint32_t>(bytes.data() + kHeader, false);
  return bytes.size() == kHeader + 4 + kTriangle * std::size_t{n} ||
         bytes.find('\0') != std::string_view::npos;
}

ImportedModel read_binary(const ImportInput& input) {
  ImportedModel model = empty_model("STL, binary");
  model.single_precision = true;
  const auto n = number_at<std::uint32_t>(input.bytes.data() + kHeader, false);
  const std::size_t there = (input.bytes.size() - kHeader - 4) / kTriangle;
  if (there < n)
    throw InputError(
        {input.place(0), fmt::format("says {} triangles and holds {}", n, there), "the file is cut short"});
  FaceCounter counter(input);
  for (std::size_t i = 0; i < n; ++i) {
    counter.add(3);
    const char* at = input.bytes.data() + kHeader + 4 + kTriangle * i + 12;  // behind the normal
    ImportedFace face;
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = static_cast<double>(number_at<float>(at + 12 * corner + 4 * axis, false));
      if (!is_finite(p))
        throw InputError(
            {input.place(0), fmt::format("triangle {} has a corner that is no number", i + 1), ""});
      face.outline.push_back(p);
    }
    model.faces.push_back(std::move(face));
  }
  return model;
}

ImportedModel read_text(const ImportInput& input) {
  ImportedModel model = empty_model("STL, text");
  FaceCounter counter(input);
  Unknowns unknowns;
  LineReader lines(input.bytes);
  std::string solid;
  ImportedFace face;
  bool any = false;
  for (std::string_view line; lines.next(line);) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    const Place place = input.place(lines.line_number());
    if (words[0] == "solid") {
      any = true;
      solid = std::string(trimmed(trimmed(line).substr(words[0].size())));
    } else if (words[0] == "vertex") {
      Vec3 p;
      for (int i = 0; i < 3; ++i)
        if (words.size() != 4 || !parse_number(words[static_cast<std::size_t>(i) + 1], p[i]))
          throw InputError({place, "vertex needs three finite numbers", ""});
      face.outline.push_back(p);
    } else if (words[0] == "endfacet") {
      if (face.outline.size() != 3)
        throw InputError({place, fmt::format("a facet of {} corners instead of 3", face.outline.size()), ""});
      counter.add(3);
      face.name = solid;
      model.faces.push_back(std::move(face));
      face = {};
    } else if (words[0] != "facet" && words[0] != "outer" && words[0] != "endloop" &&
               words[0] != "endsolid") {
      unknowns.add(fmt::format("word {} is not understood and left out", dim::quoted(words[0])), place);
    }
  }
  if (!any) throw InputError({input.place(1), "begins with no 'solid': not an STL file", ""});
  if (!face.outline.empty())
    throw InputError({input.place(lines.line_number()), "ends within a facet", "the file is cut short"});
  unknowns.tell(model.warnings);
  return model;
}

}  // namespace

ImportedModel read_stl(const ImportInput& input) {
  return is_binary(input.bytes) ? read_binary(input) : read_text(input);
}

}  // namespace dim

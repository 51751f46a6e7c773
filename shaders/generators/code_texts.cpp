#include "generators/code_texts.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>

#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

#include "blobtree/tape/tape.h"
#include "engine/kernels/kernel_constants.h"

namespace isofield::shaders {
namespace {

using operators::Applies;
using operators::Seams;

std::string text_of(std::string_view view) {
  return std::string(view);
}
std::string upper(std::string_view name) {
  return absl::AsciiStrToUpper(text_of(name));
}
std::string literal(std::uint32_t number) {
  return absl::StrCat(number, "u");
}
std::size_t words(std::size_t codes) {
  return (codes + 31) / 32;
}

std::string head(const char* about, const char* guard) {
  return absl::StrCat("// ", about, " Written by shaders/generators/code_texts.cpp.\n#ifndef ", guard, "\n#define ",
                      guard, "\n\n");
}

// Writes for each code the constant PREFIX_NAME, its number, and the macro HAS_PREFIX_NAME, which tests its bit.
template <class Traits>
void append_codes(std::string& text, std::string_view prefix, const char* word_name, std::span<const Traits> codes) {
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::string name = absl::StrCat(text_of(prefix), upper(codes[i].name));
    absl::StrAppend(&text, "const uint ", name, " = ", literal(i), ";\n#define HAS_", name, " ((", word_name, i / 32,
                    " & ", literal(1u << i % 32), ") != 0u)\n");
  }
  absl::StrAppend(&text, "\n");
}

// Returns a GLSL expression that is true if the kernel's sets hold any opcode that `applies` so, or if `terms` is not
// 0.
std::string any_of(Opcodes opcodes, Applies applies, std::string terms) {
  std::vector<std::uint32_t> masks(words(opcodes.size()));
  for (std::size_t i = 0; i < opcodes.size(); ++i) {
    if (opcodes[i].applies == applies) masks[i / 32] |= 1u << i % 32;
  }
  for (std::size_t w = 0; w < masks.size(); ++w) {
    if (masks[w] != 0) absl::StrAppend(&terms, " | (", engine::kOpcodeWordName, w, " & ", literal(masks[w]), ")");
  }
  return absl::StrCat("((", terms, ") != 0u)");
}

void append_constant(std::string& text, std::size_t id, const std::string& name, const char* value) {
  absl::StrAppend(&text, "layout(constant_id = ", id, ") const uint ", name, " = ", value, ";\n");
}

// Writes the specialisation constants. Their defaults are those of a kernel that knows every code.
void append_specialisation(std::string& text, std::size_t operand_words, std::size_t opcode_words) {
  absl::StrAppend(
      &text,
      "// A kernel is specialised to the codes of the tapes it runs: on lavapipe every branch of a shader\n"
      "// costs, taken or not, and only code that is dead at pipeline creation costs nothing. Where the tape\n"
      "// is known when GLSL is compiled (tape_points.comp), these are macros: what they switch off, some nine\n"
      "// tenths, is dropped before the driver sees it. server/engine/kernels/kernel_constants.h says what\n"
      "// each means.\n#ifndef ",
      engine::kKernelConstantNames[0], "\n");
  constexpr const char* kAll = "0xffffffffu";
  constexpr const char* kValues[] = {kAll, "0xffu", "0xffu", "16u", "0u", "16u", "0xfu", "0u"};
  static_assert(std::size(kValues) == engine::kKernelConstantNames.size());
  std::size_t id = 0;
  for (const char* name : engine::kKernelConstantNames) {
    append_constant(text, id, name, kValues[id]);
    ++id;
  }
  for (std::size_t w = 0; w < operand_words; ++w)
    append_constant(text, id++, absl::StrCat(engine::kOperandWordName, w), kAll);
  for (std::size_t w = 0; w < opcode_words; ++w)
    append_constant(text, id++, absl::StrCat(engine::kOpcodeWordName, w), kAll);
  absl::StrAppend(&text, "#endif\n\n");
}

void append_includes(std::string& text, const char* folder, const std::set<std::string>& files) {
  for (const std::string& file : files) {
    if (!file.empty()) absl::StrAppend(&text, "#include \"", folder, file, ".glsl\"\n");
  }
  absl::StrAppend(&text, "\n");
}

// Returns the test whether an instruction holds the code. The outer condition is constant, so that the compiler drops
// the branch where the kernel's sets lack the code.
std::string if_code(std::string_view prefix, std::string_view only, std::string_view variable, std::string_view name) {
  const std::string code = absl::StrCat(text_of(prefix), upper(name));
  return absl::StrCat("  if (HAS_", code, ") if (is_code(", text_of(only), ", ", text_of(variable), ", ", code, ")) ");
}

// Writes a function that calls, by opcode, the function of each opcode that `applies` so.
void append_dispatch(std::string& text, Opcodes opcodes, Applies applies, std::string_view signature,
                     std::string_view start, std::string_view prefix, std::string_view arguments) {
  absl::StrAppend(&text, text_of(signature), " {\n  Field r = ", text_of(start), ";\n");
  for (const operators::OpcodeTraits& o : opcodes) {
    if (o.applies != applies) continue;
    absl::StrAppend(&text, if_code("OPERATOR_", "ONLY_OPERATOR", "op", o.name), "r = ", text_of(prefix),
                    text_of(o.name), text_of(arguments), ";\n");
  }
  absl::StrAppend(&text, "  return r;\n}\n\n");
}

// Writes a function that tells whether an opcode `applies` so.
void append_question(std::string& text, Opcodes opcodes, Applies applies, const char* name) {
  absl::StrAppend(&text, "bool ", name, "(uint op) {\n");
  for (const operators::OpcodeTraits& o : opcodes) {
    if (o.applies == applies)
      absl::StrAppend(&text, if_code("OPERATOR_", "ONLY_OPERATOR", "op", o.name), "return true;\n");
  }
  absl::StrAppend(&text, "  return false;\n}\n\n");
}

}  // namespace

std::string codes_text(Operands operands, Opcodes opcodes) {
  using blobtree::Codes;
  std::string text = head("The codes in the instructions of tapes.", "CODES_GLSL");
  append_specialisation(text, words(operands.size()), words(opcodes.size()));
  append_codes(text, "OPERAND_", engine::kOperandWordName, operands);
  append_codes(text, "OPERATOR_", engine::kOpcodeWordName, opcodes);
  absl::StrAppend(
      &text,
      "// Returns whether the one code of all instructions, or else the code of this one, is the candidate. Where "
      "`only`\n"
      "// decides, which is constant, the driver drops the comparison with its branch.\n"
      "bool is_code(uint only, uint code, uint candidate) { return only == candidate || code == candidate; }\n\n");
  const auto number = [](auto value) { return literal(static_cast<std::uint32_t>(value)); };
  absl::StrAppend(&text, "const uint FORM_UNION = ", number(operators::Form::kUnion),
                  ", FORM_INTERSECTION = ", number(operators::Form::kIntersection),
                  ", FORM_DIFFERENCE = ", number(operators::Form::kDifference), ";\n");
  const blobtree::Mode of_signed{operators::Form::kDifference, true, false},
      plain{operators::Form::kDifference, false, false};
  const blobtree::Mode exchanged{operators::Form::kUnion, false, true};
  absl::StrAppend(&text, "const uint MODE_SIGNED = ", literal(of_signed.bits() & ~plain.bits()),
                  ", MODE_EXCHANGED = ", literal(exchanged.bits()), ";\n\n");
  const auto flag = [&](const char* macro, Codes::Flag bit) {
    absl::StrAppend(&text, "#define ", macro, "() ((CODE_FLAGS & ", number(bit), ") != 0u)\n");
  };
  flag("has_signed_leaves", Codes::kSignedLeaves);
  flag("has_modes", Codes::kModes);
  flag("may_follow_angle", Codes::kByAngle);
  flag("has_frames", Codes::kFramed);
  flag("has_sampled_openings", Codes::kSampledOpenings);
  absl::StrAppend(
      &text,
      "// Steered operators, and ranges that follow an angle, need their operands' directions.\n#define is_steered() ",
      any_of(opcodes, Applies::kSteeredTwo, absl::StrCat("(CODE_FLAGS & ", number(Codes::kByAngle), ")")),
      "\n\nconst int MAX_OPERANDS = ", operators::kMaxOperands, ";\n\n#endif\n");
  return text;
}

std::string leaves_text(Operands operands) {
  std::string text = head("The field of a leaf.", "LEAVES_GLSL");
  std::set<std::string> files;
  for (const blobtree::OperandTraits& o : operands) files.insert(text_of(o.file));
  append_includes(text, "primitives/", files);
  absl::StrAppend(&text, "Field leaf_field(vec3 p, uint operand, uint record) {\n  Field v = zero_field();\n");
  for (const blobtree::OperandTraits& o : operands) {
    if (o.record_size == 0) continue;  // no leaf
    absl::StrAppend(&text, if_code("OPERAND_", "ONLY_OPERAND", "operand", o.name), "v = ", text_of(o.name),
                    "_field(p, record);\n");
  }
  absl::StrAppend(&text, "  return v;\n}\n\n#endif\n");
  return text;
}

std::string operators_text(Opcodes opcodes) {
  std::string text = head("Applies an opcode to its operands.", "OPERATORS_GLSL");
  std::set<std::string> files;
  for (const operators::OpcodeTraits& o : opcodes) files.insert(text_of(o.file));
  append_includes(text, "operators/", files);
  append_dispatch(text, opcodes, Applies::kTwo, "Field unite(Field a, Field b, uint op, uint record, Angle angle)", "b",
                  "unite_", "(a, b, record, angle)");
  append_dispatch(text, opcodes, Applies::kSteeredTwo,
                  "Field unite_steered(Field r0, Field a, Field b, Field u, Field v, uint op, uint record)", "r0",
                  "unite_", "(a, b, u, v, record)");
  append_dispatch(text, opcodes, Applies::kMany,
                  "Field unite_many(Field x[MAX_OPERANDS], uint op, uint mask, uint record, Angle angle)", "x[0]",
                  "unite_", "(x, mask, record, angle)");
  append_dispatch(text, opcodes, Applies::kOne, "Field convert(Field r0, Field a, uint op, uint record)", "r0",
                  "apply_", "(a, record)");
  append_question(text, opcodes, Applies::kMany, "is_of_many");
  append_question(text, opcodes, Applies::kSteeredTwo, "is_steered_operator");
  absl::StrAppend(&text, "bool makes_seams(uint op, uint record) {\n");
  for (const operators::OpcodeTraits& o : opcodes) {
    if (o.seams != Seams::kHasSeams) continue;
    absl::StrAppend(&text, if_code("OPERATOR_", "ONLY_OPERATOR", "op", o.name), "return makes_seams_", text_of(o.name),
                    "(record);\n");
  }
  absl::StrAppend(&text, "  return false;\n}\n\n#endif\n");
  return text;
}

}  // namespace isofield::shaders

#include "engine/points/tape_writer.h"

#include <absl/strings/str_cat.h>

#include <bit>
#include <vector>

#include "gpu/commands.h"

namespace isofield::engine {
namespace {

using blobtree::Instruction;
using blobtree::Operand;
using operators::Opcode;

// Returns a number as a literal of GLSL's type uint.
template <class T>
std::string literal(T number) {
  return absl::StrCat(static_cast<std::uint32_t>(number), "u");
}

// Returns the name of a specialisation constant.
std::string name_of(std::size_t constant) {
  if (constant < kKernelConstantNames.size()) return kKernelConstantNames[constant];
  const std::size_t word = constant - kKernelConstantNames.size();
  return word < kOperandWords ? absl::StrCat(kOperandWordName, word)
                              : absl::StrCat(kOpcodeWordName, word - kOperandWords);
}

class Writer {
 public:
  std::string run(const blobtree::Tape& tape) {
    text_ = "Field evaluate_tape(vec3 p) {\n";
    for (const Instruction& i : tape.code) write(i);
    absl::StrAppend(&text_, "  return ", accumulator_, ";\n}\n");
    return std::move(text_);
  }

 private:
  void write(const Instruction& i) {
    if (operators::traits_of(i.op()).applies == operators::Applies::kMany) return write_many(i);
    const std::string operand = right_operand(i);
    if (i.op() == Opcode::kPush) {
      // The first instruction of a tape finds no accumulator to push.
      if (!accumulator_.empty()) waiting_.push_back(accumulator_);
      accumulator_ = operand;
      return;
    }
    accumulator_ = define(absl::StrCat("apply_operator(", accumulator_, ", ", operand, ", ", literal(i.op()), ", ",
                                       literal(i.mode().bits()), ", ", literal(i.operation), ")"));
  }

  std::string right_operand(const Instruction& i) {
    if (i.operand() == Operand::kPop) {
      std::string popped = accumulator_;
      accumulator_ = pop();
      return popped;
    }
    if (i.operand() == Operand::kZero) return "zero_field()";
    return define(absl::StrCat("leaf_field(p, ", literal(i.operand()), ", ", literal(i.leaf), ")"));
  }

  // Writes an operator that takes many operands in the order that operators.glsl expects: the last operand comes first,
  // and unused places of the array repeat it.
  void write_many(const Instruction& i) {
    std::string operands = accumulator_;
    const int count = std::popcount(i.leaf);
    for (int k = 1; k < static_cast<int>(operators::kMaxOperands); ++k) {
      absl::StrAppend(&operands, ", ", k < count ? pop() : accumulator_);
    }
    accumulator_ =
        define(absl::StrCat("apply_to_many(Field[MAX_OPERANDS](", operands, "), ", literal(i.op()), ", ",
                            literal(i.leaf), ", ", literal(i.mode().bits()), ", ", literal(i.operation), ")"));
  }

  std::string define(const std::string& value) {
    const std::string name = absl::StrCat("v", ++names_);
    absl::StrAppend(&text_, "  Field ", name, " = ", value, ";\n");
    return name;
  }

  std::string pop() {
    std::string top = std::move(waiting_.back());
    waiting_.pop_back();
    return top;
  }

  std::string text_, accumulator_;
  std::vector<std::string> waiting_;
  int names_ = 0;
};

}  // namespace

bool is_writable(const blobtree::Tape& tape) {
  constexpr std::size_t kMost = gpu::kUniformBytes / 16;
  return !tape.code.empty() && tape.leaf_records <= kMost && tape.record_owners.size() <= kMost;
}

std::string write_definitions(const KernelKind& kind, bool with_gradient) {
  std::string text = with_gradient ? "#define WITH_GRADIENT\n" : "";
  const KernelConstants constants = kind.constants();
  for (std::size_t i = 0; i < constants.size(); ++i) {
    absl::StrAppend(&text, "#define ", name_of(i), " ", literal(constants[i]), "\n");
  }
  return text;
}

std::string write_tape(const blobtree::Tape& tape) {
  return Writer().run(tape);
}

}  // namespace isofield::engine

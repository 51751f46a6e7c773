// Mirrors server/blobtree/tape/tape.h: Operand and Operator.
#ifndef OPCODES_GLSL
#define OPCODES_GLSL

const uint OPERAND_POP = 0u;
const uint OPERAND_ZERO = 1u;
const uint OPERAND_SPHERE = 2u;
const uint OPERAND_SEGMENT = 3u;
const uint OPERAND_BOX = 4u;
const uint OPERAND_CYLINDER = 5u;
const uint OPERAND_TORUS = 6u;
const uint OPERAND_ELLIPSOID = 7u;
const uint OPERAND_AFFINE_SEGMENT = 8u;

const uint OPERATOR_PUSH = 0u;
const uint OPERATOR_SUM = 1u;
const uint OPERATOR_MAX = 2u;
const uint OPERATOR_MIN = 3u;
const uint OPERATOR_SUBTRACT = 4u;
const uint OPERATOR_SUBTRACT_FROM = 5u;
const uint OPERATOR_RICCI = 6u;
const uint OPERATOR_GRADIENT = 7u;
const uint OPERATOR_GRADIENT_TABLE = 8u;
const uint OPERATOR_GRADIENT_VOLUME = 9u;
const uint OPERATOR_CLEAN = 10u;
const uint OPERATOR_BARTHE = 11u;
const uint OPERATOR_BERNHARDT = 12u;
const uint OPERATOR_PASKO = 13u;
const uint OPERATOR_FUNCTIONAL = 14u;
const uint OPERATOR_BT2 = 15u;
const uint OPERATOR_SUPERELLIPTIC = 16u;
const uint OPERATOR_BTK = 17u;
const uint OPERATOR_LINEAR = 18u;
const uint OPERATOR_SOFTEN = 19u;

// Bits of the sets beside those of the opcodes.
const uint SIGNED_LEAVES = 1u << 31u;     // OPERAND_SET
const uint MODES = 1u << 31u;             // OPERATOR_SET
const uint BY_ANGLE = 1u << 30u;          // OPERATOR_SET
const uint FRAMED = 1u << 29u;            // OPERATOR_SET
const uint SAMPLED_OPENINGS = 1u << 28u;  // OPERATOR_SET

// Modes of an instruction: Mode::bits().
const uint FORM_UNION = 0u;
const uint FORM_INTERSECTION = 1u;
const uint FORM_DIFFERENCE = 2u;
const uint MODE_SIGNED = 4u;
const uint MODE_EXCHANGED = 8u;

// A kernel is specialised to the opcodes of the tapes it runs: on lavapipe every branch of a shader costs, taken or not,
// and only code that is dead at pipeline creation costs nothing. Where the tape is known when GLSL is compiled
// (tape_points.comp), these are macros: what they switch off, some nine tenths, is dropped before the driver sees it.
#ifndef OPERAND_SET
layout(constant_id = 0) const uint OPERAND_SET = 0xffffffffu;
layout(constant_id = 1) const uint OPERATOR_SET = 0xffffffffu;
layout(constant_id = 2) const uint STACK_DEPTH = 16u;
// Instructions of every tape, or 0 where they differ. A known length leaves no loop, and lavapipe reads what all
// invocations share once, rather than once for each, outside of loops and branches alone.
layout(constant_id = 3) const uint TAPE_LENGTH = 0u;
// Most operands of an n-ary operator.
layout(constant_id = 4) const uint ARITY = 16u;
// The slots of volumes that a kernel's tapes use, by bits: the look-up in another is dropped before compilation.
layout(constant_id = 5) const uint VOLUME_SET = 0xfu;
// Parameters in uniform buffers. 1: leaves, 2: operations, 4: tape; 8, with all of these: invocations share loads.
layout(constant_id = 6) const uint UNIFORM_SET = 0u;
#endif

// Macros, since GLSL's compiler folds no calls.
#define has_operand(operand) ((OPERAND_SET >> (operand) & 1u) != 0u)
#define has_operator(op) ((OPERATOR_SET >> (op) & 1u) != 0u)
#define has_modes() ((OPERATOR_SET & MODES) != 0u)
#define has_signed_leaves() ((OPERAND_SET & SIGNED_LEAVES) != 0u)
// Whether a kernel's operators may follow an angle; one does whose omega is not negative.
#define may_follow_angle() ((OPERATOR_SET & BY_ANGLE) != 0u)
// Whether operators that follow an angle measure it in a frame of their own, which stands before their record.
#define has_frames() ((OPERATOR_SET & FRAMED) != 0u)

// Whether openings may be given by samples.
#define has_sampled_openings() ((OPERATOR_SET & SAMPLED_OPENINGS) != 0u)

// Comparisons that the sets decide are dropped with their branches.
bool is_operand(uint operand, uint candidate) {
  return has_operand(candidate) && ((OPERAND_SET & ~SIGNED_LEAVES) == 1u << candidate || operand == candidate);
}
// Of instructions after the first, which pushes.
bool is_operator(uint op, uint candidate) {
  return has_operator(candidate) && (OPERATOR_SET == (1u << OPERATOR_PUSH | 1u << candidate) && STACK_DEPTH == 0u || op == candidate);
}
// The same, where the compiler drops what no set has.
#define IF_OPERAND(operand, candidate) \
  if (has_operand(candidate)) if (is_operand(operand, candidate))
#define IF_OPERATOR(op, candidate) \
  if (has_operator(candidate)) if (is_operator(op, candidate))

// Gradient blends, and ranges that follow an angle, steer by their operands' directions; a tape without them need not
// carry any.
#define is_steered()                                                                                               \
  ((OPERATOR_SET & (1u << OPERATOR_GRADIENT | 1u << OPERATOR_GRADIENT_TABLE | 1u << OPERATOR_GRADIENT_VOLUME |        \
                    BY_ANGLE)) != 0u)

#endif

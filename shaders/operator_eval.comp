// Evaluates one operator at given field values: its value and partial derivatives. An invocation takes one row of
// arguments.
//
// The operands are fields whose directions are unit vectors, so that the direction of the result holds the partials:
// those by up to three operands at a time, or those by two operands and by theta or alpha.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "instruction.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_OPERATOR_EVAL_ARGUMENTS) readonly buffer Arguments { float arguments[]; };
layout(std430, binding = BINDING_OPERATOR_EVAL_RESULTS) writeonly buffer Results { float results[]; };

const uint STEERING_NONE = 0u, STEERING_THETA = 1u, STEERING_ALPHA = 2u;

layout(push_constant) uniform Constants {
  uint count;
  uint operands;
  // A row of arguments holds the fields, and after them tan(theta) or alpha or, for an operator that follows an angle,
  // the angle's cosine and sine and the ratio of the gradients' lengths. The host computes these functions to the last
  // bit; in Vulkan their error may be 2^-11.
  uint columns;
  uint steering;
  uint code;      // in the form of an instruction's first word
  uint record;
  uint is_opening;  // the column is alpha, the results are theta and its derivative
};

Field operand(float f, uint slot) {
  Field a = zero_field();
  a.f = f;
  if (slot < 3u) a.d[slot] = 1.0;
  a.g = a.d;
  return a;
}

// Returns the blend at tan(theta) = `by`, or at alpha = `by` through the opening. Component 2 of the direction is the
// derivative by theta or alpha.
Field steered(Field a, Field b, uint op, float by) {
  vec4 operation = operation_at(record);
  vec2 t = vec2(by, 1.0 + by * by);
  if (steering == STEERING_ALPHA) t = opening_tangent(floatBitsToUint(operation.x), by);
  uint blend = floatBitsToUint(operation.y);
  Blend g;
  if (HAS_OPERATOR_GRADIENT && op == OPERATOR_GRADIENT) g = gradient_blend(a.f, b.f, t.x, SMOOTH_SILHOUETTE);
  else if (HAS_OPERATOR_GRADIENT_VOLUME && op == OPERATOR_GRADIENT_VOLUME) {
    g = volume_blend(a.f, b.f, t.x, blend & 0xffu, blend >> 8u, operation.w > 0.0);
  } else g = gradient_blend(a.f, b.f, t.x, silhouette_half(blend, a.f, b.f));
  Field r = zero_field();
  r.f = g.g;
  r.d = g.g1 * a.d + g.g2 * b.d + vec3(0.0, 0.0, g.gt * t.y);
  r = select_field(r, a, b.f <= 0.0);
  return select_field(r, b, a.f <= 0.0);
}

// Returns the operator's result for a row, with derivatives by the three operands from `slot` on.
Field result(uint row, uint slot) {
  uint op = code >> 8u & 0xffu, mode = code >> 16u, at = row * columns;
  float by = steering != STEERING_NONE ? arguments[at + operands] : 0.0;
  Angle angle = no_angle();
  if (may_follow_angle()) {
    float sine = arguments[at + operands + 1u];
    angle.cosine = vec4(by, 0.0, 0.0, -sine) * ((mode & 3u) == FORM_DIFFERENCE ? -1.0 : 1.0);
    float cosine = value_of(angle.cosine);
    angle.versine = chain(angle.cosine, cosine > 0.0 ? sine * sine / (1.0 + cosine) : 1.0 - cosine, -1.0);
    angle.ratio = dual(clamp(arguments[at + operands + 2u], 1.0 / MOST_RATIO, MOST_RATIO));
  }
  Field r = zero_field();
  if (is_of_many(op)) {
    Field x[MAX_OPERANDS];
    for (uint j = 0u; j < uint(MAX_OPERANDS); ++j) {
      x[j] = zero_field();
      uint k = operands - 1u - j;
      if (j < operands) x[j] = operand(arguments[at + k], k - slot);
    }
    uint mask = (1u << operands) - 1u, form = mode & 3u;
    if (form != FORM_UNION) turn_operands(x, mask, form);
    angle.ratio = reciprocal(angle.ratio);  // x[0], the last operand, comes first
    r = unite_many(x, op, mask, record, angle);
    r = select_field(r, linear(r, -1.0, 0.0), form != FORM_UNION);
  } else {
    Field a = operand(arguments[at], 0u), b = operand(arguments[at + 1u], 1u);
    Field first = a, second = b;
    if (has_modes()) {
      a = select_field(a, complement(a, mode), (mode & 3u) != FORM_UNION);
      b = select_field(b, complement(b, mode), (mode & 3u) == FORM_INTERSECTION);
    }
    if (is_steered_operator(op)) r = steered(a, b, op, by);
    else r = unite(a, b, op, record, angle);
    if (has_modes()) r = formed(r, first, second, mode);
  }
  // Operators that follow an angle have the derivative by it only in the gradient.
  if (may_follow_angle()) r.d = r.g;
  return r;
}

// Returns x, or the largest float32 number of its sign if x is beyond float32.
float within_float(float x) { return clamp(x, -3.4028235e38, 3.4028235e38); }

void main() {
  uint row = gl_GlobalInvocationID.x;
  if (row >= count) return;
  if (is_opening != 0u) {
    vec2 t = opening_tangent(floatBitsToUint(operation_at(record).x), arguments[row]);
    results[2u * row] = arctangent(t.x);
    results[2u * row + 1u] = t.y / (1.0 + t.x * t.x);
    return;
  }
  bool is_steered_row = steering != STEERING_NONE;
  uint width = 1u + operands + (is_steered_row ? 1u : 0u);
  for (uint slot = 0u; slot < operands; slot += 3u) {
    Field r = result(row, slot);
    if (slot == 0u) results[row * width] = within_float(r.f);
    for (uint k = 0u; k < min(operands - slot, 3u); ++k) results[row * width + 1u + slot + k] = within_float(r.d[k]);
    if (is_steered_row) results[row * width + 3u] = within_float(r.d.z);  // two operands
  }
}

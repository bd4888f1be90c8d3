layout(location = 1) uniform uint id;
layout(location = 0) out vec4 colour;
layout(location = 1) out uint target_id;

void main()
{
    colour = vec4(float(id) / 255.0, 0.0, 0.0, 1.0);
    target_id = id;
}

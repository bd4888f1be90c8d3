in vec4 uv;
out vec4 colour;
void main() { colour = uv; }

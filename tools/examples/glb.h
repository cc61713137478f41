/* A small reader of binary glTF for the examples: triangles with normals, nodes, base colours, one camera,
 * lights. It takes what `afterglow scene NAME -o room.glb` writes and files like it; it is no model of how to
 * read files from strangers. */
#ifndef EXAMPLES_GLB_H
#define EXAMPLES_GLB_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct GlbMesh { /* one primitive */
    uint32_t firstVertex, vertexCount, firstIndex, indexCount, material;
} GlbMesh;
typedef struct GlbInstance {
    uint32_t mesh;
    float world[12]; /* columns: three axes and the place */
} GlbInstance;
typedef struct GlbLight {
    int kind; /* 0 directional, 1 point, 2 spot */
    float position[3], direction[3], intensity[3], inner, outer, range;
} GlbLight;
typedef struct Glb {
    float* vertices;   /* position and normal, six floats each */
    uint32_t* indices; /* into the mesh's own vertices */
    uint32_t vertexCount, indexCount, meshCount, instanceCount, materialCount, lightCount;
    GlbMesh meshes[256];
    GlbInstance instances[256];
    GlbLight lights[8];
    float albedo[256][3];
    float camera[12], verticalFov, nearPlane;
} Glb;

/* --- JSON: a value is where its text begins. --- */
static const char* glbSpace(const char* s) {
    while (*s == ' ' || *s == '\n' || *s == '\r' || *s == '\t' || *s == ',' || *s == ':')
        ++s;
    return s;
}
static const char* glbSkip(const char* s) { /* past one value */
    int depth = 0;
    s = glbSpace(s);
    do {
        if (*s == '"') {
            for (++s; *s != '"'; ++s)
                s += *s == '\\';
            ++s;
        } else if (*s == '{' || *s == '[') {
            ++depth, ++s;
        } else if (*s == '}' || *s == ']') {
            --depth, ++s;
        } else {
            while (*s && !strchr(",:]} \n\r\t\"", *s))
                ++s;
        }
        if (depth > 0) s = glbSpace(s);
    } while (depth > 0 && *s);
    return s;
}
static const char* glbGet(const char* object, const char* key) { /* null if it is not there */
    if (!object) return NULL;
    const char* s = glbSpace(object);
    if (*s != '{') return NULL;
    for (s = glbSpace(s + 1); *s && *s != '}'; s = glbSpace(s)) {
        const size_t length = strlen(key);
        const int found = *s == '"' && strncmp(s + 1, key, length) == 0 && s[length + 1] == '"';
        s = glbSpace(glbSkip(s));
        if (found) return s;
        s = glbSkip(s);
    }
    return NULL;
}
static const char* glbAt(const char* array, int index) {
    if (!array) return NULL;
    const char* s = glbSpace(glbSpace(array) + 1);
    for (; *s && *s != ']'; s = glbSpace(glbSkip(s)))
        if (index-- == 0) return s;
    return NULL;
}
static double glbNumber(const char* value, double otherwise) {
    return value ? atof(glbSpace(value)) : otherwise;
}
static void glbNumbers(const char* array, float* out, int count) {
    for (int i = 0; array && i < count; ++i)
        out[i] = (float)glbNumber(glbAt(array, i), out[i]);
}

/* --- The file --- */
static const uint8_t* glbAccessor(const char* json, const uint8_t* bytes, int index, uint32_t* count,
                                  uint32_t* stride, int* component) {
    const char* a = glbAt(glbGet(json, "accessors"), index);
    const char* view = glbAt(glbGet(json, "bufferViews"), (int)glbNumber(glbGet(a, "bufferView"), 0));
    *count = (uint32_t)glbNumber(glbGet(a, "count"), 0);
    *component = (int)glbNumber(glbGet(a, "componentType"), 0);
    const uint32_t packed = *component == 5126 ? 12 : *component == 5125 ? 4 : *component == 5123 ? 2 : 1;
    *stride = (uint32_t)glbNumber(glbGet(view, "byteStride"), packed);
    return bytes + (size_t)(glbNumber(glbGet(a, "byteOffset"), 0) + glbNumber(glbGet(view, "byteOffset"), 0));
}

static void glbMultiply(const float* a, const float* b, float* out) { /* 3x4 matrices, columns */
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r)
            out[c * 3 + r] =
                a[r] * b[c * 3] + a[3 + r] * b[c * 3 + 1] + a[6 + r] * b[c * 3 + 2] + (c == 3 ? a[9 + r] : 0);
}

static void glbLocal(const char* node, float* m) {
    float t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (glbGet(node, "matrix")) {
        float whole[16];
        glbNumbers(glbGet(node, "matrix"), whole, 16);
        for (int c = 0; c < 4; ++c)
            memcpy(m + c * 3, whole + c * 4, 3 * sizeof(float));
        return;
    }
    glbNumbers(glbGet(node, "translation"), t, 3);
    glbNumbers(glbGet(node, "rotation"), q, 4);
    glbNumbers(glbGet(node, "scale"), s, 3);
    const float x = q[0], y = q[1], z = q[2], w = q[3];
    const float r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
                        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
                        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y)};
    for (int i = 0; i < 9; ++i)
        m[i] = r[i] * s[i / 3];
    memcpy(m + 9, t, sizeof t);
}

static void glbPrimitive(Glb* g, const char* json, const uint8_t* bytes, const char* p) {
    uint32_t count, stride, ignored;
    int component;
    const char* attributes = glbGet(p, "attributes");
    const uint8_t* at = glbAccessor(json, bytes, (int)glbNumber(glbGet(attributes, "POSITION"), 0), &count,
                                    &stride, &component);
    uint32_t normalStride;
    const uint8_t* normals = glbAccessor(json, bytes, (int)glbNumber(glbGet(attributes, "NORMAL"), 0),
                                         &ignored, &normalStride, &component);
    GlbMesh* mesh = &g->meshes[g->meshCount++];
    mesh->firstVertex = g->vertexCount, mesh->vertexCount = count, mesh->firstIndex = g->indexCount;
    mesh->material = (uint32_t)glbNumber(glbGet(p, "material"), 0);
    g->vertices = realloc(g->vertices, (g->vertexCount + count) * 6 * sizeof(float));
    for (uint32_t i = 0; i < count; ++i) {
        memcpy(g->vertices + (g->vertexCount + i) * 6, at + (size_t)i * stride, 12);
        memcpy(g->vertices + (g->vertexCount + i) * 6 + 3, normals + (size_t)i * normalStride, 12);
    }
    g->vertexCount += count;
    at = glbAccessor(json, bytes, (int)glbNumber(glbGet(p, "indices"), 0), &count, &stride, &component);
    mesh->indexCount = count;
    g->indices = realloc(g->indices, (g->indexCount + count) * sizeof(uint32_t));
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t index = 0;
        memcpy(&index, at + (size_t)i * stride, stride); /* little endian, as glTF is */
        g->indices[g->indexCount++] = index;
    }
}

static void glbNode(Glb* g, const char* json, int index, const float* parent, const int* firstMesh) {
    const char* node = glbAt(glbGet(json, "nodes"), index);
    float local[12], world[12];
    glbLocal(node, local);
    glbMultiply(parent, local, world);
    if (glbGet(node, "mesh")) {
        const int mesh = (int)glbNumber(glbGet(node, "mesh"), 0);
        for (int p = firstMesh[mesh]; p < firstMesh[mesh + 1]; ++p) {
            g->instances[g->instanceCount].mesh = (uint32_t)p;
            memcpy(g->instances[g->instanceCount++].world, world, sizeof world);
        }
    }
    if (glbGet(node, "camera")) {
        const char* camera = glbAt(glbGet(json, "cameras"), (int)glbNumber(glbGet(node, "camera"), 0));
        memcpy(g->camera, world, sizeof world);
        g->verticalFov = (float)glbNumber(glbGet(glbGet(camera, "perspective"), "yfov"), 0.8);
        g->nearPlane = (float)glbNumber(glbGet(glbGet(camera, "perspective"), "znear"), 0.05);
    }
    const char* light = glbGet(glbGet(glbGet(node, "extensions"), "KHR_lights_punctual"), "light");
    if (light && g->lightCount < 8) {
        const char* all = glbGet(glbGet(glbGet(json, "extensions"), "KHR_lights_punctual"), "lights");
        const char* l = glbAt(all, (int)glbNumber(light, 0));
        const char* type = glbSpace(glbGet(l, "type"));
        GlbLight* out = &g->lights[g->lightCount++];
        out->kind = type[1] == 'd' ? 0 : type[1] == 'p' ? 1 : 2;
        out->range = (float)glbNumber(glbGet(l, "range"), 0);
        out->inner = (float)glbNumber(glbGet(glbGet(l, "spot"), "innerConeAngle"), 0);
        out->outer = (float)glbNumber(glbGet(glbGet(l, "spot"), "outerConeAngle"), 0.785398);
        float color[3] = {1, 1, 1};
        glbNumbers(glbGet(l, "color"), color, 3);
        for (int i = 0; i < 3; ++i) {
            out->position[i] = world[9 + i];
            out->direction[i] = -world[6 + i];
            out->intensity[i] = color[i] * (float)glbNumber(glbGet(l, "intensity"), 1);
        }
    }
    const char* children = glbGet(node, "children");
    for (int i = 0; glbAt(children, i); ++i)
        glbNode(g, json, (int)glbNumber(glbAt(children, i), 0), world, firstMesh);
}

/* 0 if the file cannot be read. */
static int glbLoad(const char* path, Glb* g) {
    FILE* file = fopen(path, "rb");
    if (!file) return 0;
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    rewind(file);
    uint8_t* data = calloc(1, (size_t)size + 1);
    const int whole =
        size > 20 && fread(data, 1, (size_t)size, file) == (size_t)size && memcmp(data, "glTF", 4) == 0;
    fclose(file);
    memset(g, 0, sizeof *g);
    if (whole) {
        uint32_t jsonSize;
        memcpy(&jsonSize, data + 12, 4);
        char* json = calloc(1, jsonSize + 1);
        memcpy(json, data + 20, jsonSize);
        const uint8_t* bytes = data + 20 + jsonSize + 8;
        const char* materials = glbGet(json, "materials");
        for (; g->materialCount < 256 && glbAt(materials, (int)g->materialCount); ++g->materialCount) {
            float base[4] = {1, 1, 1, 1};
            glbNumbers(glbGet(glbGet(glbAt(materials, (int)g->materialCount), "pbrMetallicRoughness"),
                              "baseColorFactor"),
                       base, 4);
            memcpy(g->albedo[g->materialCount], base, 3 * sizeof(float));
        }
        int firstMesh[257] = {0}, mesh = 0;
        for (; mesh < 256 && glbAt(glbGet(json, "meshes"), mesh); ++mesh) {
            const char* primitives = glbGet(glbAt(glbGet(json, "meshes"), mesh), "primitives");
            for (int p = 0; glbAt(primitives, p); ++p)
                glbPrimitive(g, json, bytes, glbAt(primitives, p));
            firstMesh[mesh + 1] = (int)g->meshCount;
        }
        const float identity[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
        const char* roots =
            glbGet(glbAt(glbGet(json, "scenes"), (int)glbNumber(glbGet(json, "scene"), 0)), "nodes");
        for (int i = 0; glbAt(roots, i); ++i)
            glbNode(g, json, (int)glbNumber(glbAt(roots, i), 0), identity, firstMesh);
        free(json);
    }
    free(data);
    return whole && g->instanceCount > 0;
}

#endif

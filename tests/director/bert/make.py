"""Writes a tiny BERT with random weights as `transformers` stores it, and its states of one text computed with NumPy in f64.

The computation follows Devlin et al. 2019 and Vaswani et al. 2017 and shares no code with the program:
    python3 tests/director/bert/make.py
"""

import json
import math
import struct
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent
WIDTH, HEADS, HIDDEN, LAYERS, POSITIONS = 12, 3, 20, 2, 256
# In the order of their ids.
PIECES = "[PAD] [UNK] [CLS] [SEP] thing seconds degrees meters times percent lens slow ##ly push in on the , unused".split()
# "slowly push in on <obj-0> , <qty-0>", where the quantity is a number of seconds.
TOKENS = ["[CLS]", "slow", "##ly", "push", "in", "on", "thing", ",", "QUANTITY", "[SEP]"]


def main():
    rng = np.random.default_rng(7)
    draw = lambda *shape: (0.5 * rng.standard_normal(shape)).astype(np.float32)
    tensors = {
        "embeddings.word_embeddings.weight": draw(len(PIECES), WIDTH),
        "embeddings.position_embeddings.weight": draw(POSITIONS, WIDTH),
        "embeddings.token_type_embeddings.weight": draw(2, WIDTH),
        "embeddings.LayerNorm.weight": 1 + draw(WIDTH),
        "embeddings.LayerNorm.bias": draw(WIDTH),
    }
    for layer in range(LAYERS):
        sizes = {
            "attention.self.query": (WIDTH, WIDTH),
            "attention.self.key": (WIDTH, WIDTH),
            "attention.self.value": (WIDTH, WIDTH),
            "attention.output.dense": (WIDTH, WIDTH),
            "intermediate.dense": (HIDDEN, WIDTH),
            "output.dense": (WIDTH, HIDDEN),
        }
        for name, (outs, ins) in sizes.items():
            tensors[f"encoder.layer.{layer}.{name}.weight"] = draw(outs, ins)
            tensors[f"encoder.layer.{layer}.{name}.bias"] = draw(outs)
        for name in ["attention.output.LayerNorm", "output.LayerNorm"]:
            tensors[f"encoder.layer.{layer}.{name}.weight"] = 1 + draw(WIDTH)
            tensors[f"encoder.layer.{layer}.{name}.bias"] = draw(WIDTH)
    write_safetensors(FOLDER / "model.safetensors", tensors)
    (FOLDER / "vocab.txt").write_text("\n".join(PIECES) + "\n")
    sizes = {"hidden_size": WIDTH, "intermediate_size": HIDDEN, "num_attention_heads": HEADS, "num_hidden_layers": LAYERS}
    (FOLDER / "config.json").write_text(json.dumps(sizes) + "\n")
    states = bert({name: values.astype(np.float64) for name, values in tensors.items()})
    (FOLDER / "states.json").write_text(json.dumps([[round(x, 7) for x in row] for row in states.tolist()]) + "\n")


def bert(t):
    words = t["embeddings.word_embeddings.weight"]
    # A quantity has only its kind.
    rows = [words[PIECES.index("seconds" if token == "QUANTITY" else token)] for token in TOKENS]
    x = np.stack(rows) + t["embeddings.position_embeddings.weight"][: len(rows)] + t["embeddings.token_type_embeddings.weight"][0]
    x = norm(x, t, "embeddings.LayerNorm")
    for layer in range(LAYERS):
        p = f"encoder.layer.{layer}."
        query, key, value = (linear(x, t, f"{p}attention.self.{part}") for part in ["query", "key", "value"])
        heads = []
        for head in np.split(np.arange(WIDTH), HEADS):
            scores = query[:, head] @ key[:, head].T / math.sqrt(len(head))
            weights = np.exp(scores - scores.max(axis=1, keepdims=True))
            heads.append(weights / weights.sum(axis=1, keepdims=True) @ value[:, head])
        x = norm(x + linear(np.concatenate(heads, axis=1), t, p + "attention.output.dense"), t, p + "attention.output.LayerNorm")
        hidden = linear(x, t, p + "intermediate.dense")
        hidden = hidden * 0.5 * (1 + np.vectorize(math.erf)(hidden / math.sqrt(2)))
        x = norm(x + linear(hidden, t, p + "output.dense"), t, p + "output.LayerNorm")
    return x


def linear(x, t, name):
    return x @ t[name + ".weight"].T + t[name + ".bias"]


def norm(x, t, name):
    centered = x - x.mean(axis=1, keepdims=True)
    scaled = centered / np.sqrt((centered**2).mean(axis=1, keepdims=True) + 1e-12)
    return scaled * t[name + ".weight"] + t[name + ".bias"]


def write_safetensors(path, tensors):
    header, data = {}, b""
    for name in sorted(tensors):
        values = tensors[name]
        header[name] = {"dtype": "F32", "shape": list(values.shape), "data_offsets": [len(data), len(data) + values.nbytes]}
        data += values.tobytes()
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 8)
    path.write_bytes(struct.pack("<Q", len(text)) + text + data)


main()

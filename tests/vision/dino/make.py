"""Writes a tiny DINOv2 with random weights as `transformers` stores it, two pictures, and what PyTorch makes of them.

One picture has the size that the network was made for; the other has another one, for which the position embeddings are
interpolated:
    pip install torch transformers numpy
    python3 tests/vision/dino/make.py
"""

from pathlib import Path

import numpy as np
import torch
from safetensors.torch import load_file, save_file
from transformers import Dinov2Config, Dinov2Model

FOLDER = Path(__file__).parent
# Rows and columns of the pictures, px.
SIZES = {"native": (42, 42), "other": (28, 56)}
MEAN, STD = [0.485, 0.456, 0.406], [0.229, 0.224, 0.225]


def main():
    torch.manual_seed(7)
    config = Dinov2Config(
        hidden_size=32,
        num_hidden_layers=2,
        num_attention_heads=2,
        mlp_ratio=2,
        image_size=42,
        patch_size=14,
        attn_implementation="eager",
    )
    model = Dinov2Model(config).eval()
    with torch.no_grad():
        for name, values in model.named_parameters():
            # Large enough that each part of the network moves the result.
            values.copy_(0.3 * torch.randn(values.shape) + (1.0 if "norm" in name and name.endswith("weight") else 0.0))
            # A half holds them exactly, which keeps the file small.
            values.copy_(values.half().float())
    model.half().save_pretrained(FOLDER)
    model.float()
    expected = {}
    for name, size in SIZES.items():
        rgb8 = torch.randint(0, 256, (*size, 3), dtype=torch.uint8)
        normalized = (rgb8.float() / 255 - torch.tensor(MEAN)) / torch.tensor(STD)
        with torch.no_grad():
            states = model(pixel_values=normalized.permute(2, 0, 1)[None]).last_hidden_state[0, 1:]
        expected[f"{name}.rgb8"] = rgb8
        expected[f"{name}.patches"] = states.reshape(size[0] // 14, size[1] // 14, -1).contiguous()
        print(name, "largest", float(states.abs().max()))
    save_file(expected, FOLDER / "expected.safetensors")
    for name, values in load_file(FOLDER / "model.safetensors").items():
        print(name, tuple(values.shape), values.dtype)


main()

(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Reads what the filters in C said, a line for each vector: NAME INPUT ... = OUTPUT, doubles as 16 hexadecimal digits of
   their bits; prints the lines on which the definition says something else, and how many lines there were of each name. *)
module Integer = Z
open Filters

let double text = b64_of_bits (Integer.of_string ("0x" ^ text))

let bits x = if is_nan_double x then "nan" else Integer.format "%016x" (bits_of_b64 x)

let maybe = function Some sign -> Integer.to_string sign | None -> "none"

let answer name a =
  let at k = a.(k) in
  let box k = box a.(k) a.(k + 1) a.(k + 2) a.(k + 3) in
  match (name, Array.length a) with
  | "orient_bound", 3 -> bits (orient_bound (at 0) (at 1) (at 2))
  | "orient", 7 -> Integer.to_string (filter_orient (at 0) (at 1) (at 2) (at 3) (at 4) (at 5) (at 6))
  | "orient_near", 7 -> Integer.to_string (filter_orient_near (at 0) (at 1) (at 2) (at 3) (at 4) (at 5) (at 6))
  | "orient_small", 7 -> maybe (filter_orient_small (at 0) (at 1) (at 2) (at 3) (at 4) (at 5) (at 6))
  | "incircle_at", 9 -> Integer.to_string (filter_incircle_at (at 0) (at 1) (at 2) (at 3) (at 4) (at 5) (at 6) (at 7) (at 8))
  | "incircle_near", 9 ->
    Integer.to_string (filter_incircle_near (at 0) (at 1) (at 2) (at 3) (at 4) (at 5) (at 6) (at 7) (at 8))
  | "incircle_small", 9 -> maybe (filter_incircle_small (at 0) (at 1) (at 2) (at 3) (at 4) (at 5) (at 6) (at 7) (at 8))
  | "lower", 1 -> bits (lower (at 0))
  | "upper", 1 -> bits (upper (at 0))
  | "ds2_lower", 8 -> bits (ds2_lower (box 0) (box 4))
  | "dl2_upper", 8 -> bits (dl2_upper (box 0) (box 4))
  | "ds2_upper", 9 -> bits (ds2_upper (box 0) (box 4) (at 8))
  | "dl2_lower", 9 -> bits (dl2_lower (box 0) (box 4) (at 8))
  | _ -> failwith ("there is no definition " ^ name)

let count = Hashtbl.create 20

let wrong line =
  match String.split_on_char '=' line with
  | [ left; right ] -> (
    match String.split_on_char ' ' (String.trim left) with
    | name :: inputs ->
      Hashtbl.replace count name (1 + Option.value ~default:0 (Hashtbl.find_opt count name));
      let says = answer name (Array.of_list (List.map double inputs)) in
      if says = String.trim right then false
      else (
        Printf.printf "%s, by the definition %s\n" line says;
        true)
    | [] -> failwith "a line without a name")
  | _ -> failwith ("no vector: " ^ line)

let () =
  let bad = ref 0 in
  (try
     while true do
       if wrong (input_line stdin) then incr bad
     done
   with End_of_file -> ());
  Hashtbl.iter (Printf.printf "%s: %d vectors\n") count;
  Printf.printf "%d differ\n" !bad;
  exit (if !bad > 0 || Hashtbl.length count = 0 then 1 else 0)

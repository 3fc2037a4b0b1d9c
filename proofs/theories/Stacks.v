(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Balls of an expression hold its values, node by node, if every operation does so; monotone functions, and the tails
   of exp and tanh [ENC-1]. *)
From Coq Require Import Reals Lra Lia List.
Import ListNotations.
Open Scope R_scope.

(* A ball, by its ends. *)
Definition ball : Type := (R * R)%type.
Definition holds (b : ball) (x : R) : Prop := fst b <= x <= snd b.

(* ---- the stack ---- *)

(* A node takes its operands from a stack and leaves its value there; None: undefined, or not yet. *)
Inductive node (A : Type) : Type :=
| Leaf (v : option A)
| Unary (f : A -> option A)
| Binary (f : A -> A -> option A).
Arguments Leaf {A}. Arguments Unary {A}. Arguments Binary {A}.

Definition step {A} (s : list A) (n : node A) : option (list A) :=
  match n, s with
  | Leaf (Some v), _ => Some (v :: s)
  | Unary f, x :: rest => match f x with Some v => Some (v :: rest) | None => None end
  | Binary f, y :: x :: rest => match f x y with Some v => Some (v :: rest) | None => None end
  | _, _ => None
  end.

Fixpoint run {A} (s : list A) (l : list (node A)) : option (list A) :=
  match l with
  | [] => Some s
  | n :: rest => match step s n with Some s' => run s' rest | None => None end
  end.

(* The operation on balls holds what the one on numbers gives. *)
Definition sound (n : node R) (b : node ball) : Prop :=
  match n, b with
  | Leaf (Some v), Leaf (Some c) => holds c v
  | Leaf _, Leaf _ => True
  | Unary f, Unary g => forall x c v d, holds c x -> f x = Some v -> g c = Some d -> holds d v
  | Binary f, Binary g => forall x y c e v d, holds c x -> holds e y -> f x y = Some v -> g c e = Some d -> holds d v
  | _, _ => False
  end.

Lemma step_holds n b s t s' t' : sound n b -> Forall2 holds t s -> step s n = Some s' -> step t b = Some t' ->
  Forall2 holds t' s'.
Proof.
  intros S H A C. destruct n as [[v |] | f | f]; destruct b as [[c |] | g | g]; simpl in *; try easy.
  - injection A as <-. injection C as <-. now constructor.
  - destruct H as [| c x t s Hx H]; [discriminate |]. destruct (f x) as [v |] eqn:F; [| discriminate].
    destruct (g c) as [d |] eqn:G; [| discriminate]. injection A as <-. injection C as <-.
    constructor; [now apply (S x c v d) | exact H].
  - destruct H as [| e y t s Hy H]; [discriminate |]. destruct H as [| c x t s Hx H]; [discriminate |].
    destruct (f x y) as [v |] eqn:F; [| discriminate]. destruct (g c e) as [d |] eqn:G; [| discriminate].
    injection A as <-. injection C as <-. constructor; [now apply (S x y c e v d) | exact H].
Qed.

(* After each step every ball holds the value of its node. *)
Theorem run_holds l : forall m s t s' t', Forall2 sound l m -> Forall2 holds t s -> run s l = Some s' ->
  run t m = Some t' -> Forall2 holds t' s'.
Proof.
  induction l as [| n l IH]; intros m s t s' t' S H A C; inversion S as [| ? b ? m' Sn Sl]; subst; simpl in *.
  - injection A as <-. now injection C as <-.
  - destruct (step s n) as [s1 |] eqn:E; [| discriminate]. destruct (step t b) as [t1 |] eqn:F; [| discriminate].
    apply (IH m' s1 t1); auto. now apply (step_holds n b s t).
Qed.

(* ---- monotone functions ---- *)

(* Ends cut to a range that the value lies in; the hull of the balls that hold the values there. *)
Definition hull (b c : ball) : ball := (Rmin (fst b) (fst c), Rmax (snd b) (snd c)).

Theorem monotone_holds f lo hi b low high x : lo <= x <= hi -> holds b x ->
  (forall u v, lo <= u <= v -> v <= hi -> f u <= f v) \/ (forall u v, lo <= u <= v -> v <= hi -> f v <= f u) ->
  holds low (f (Rmax lo (fst b))) -> holds high (f (Rmin hi (snd b))) -> holds (hull low high) (f x).
Proof.
  unfold holds, hull. simpl. intros X B M L H.
  assert (P : lo <= Rmax lo (fst b) <= x) by (split; [apply Rmax_l | apply Rmax_lub; lra]).
  assert (Q : x <= Rmin hi (snd b) <= hi) by (split; [apply Rmin_glb; lra | apply Rmin_l]).
  pose proof (Rmin_l (fst low) (fst high)). pose proof (Rmin_r (fst low) (fst high)).
  pose proof (Rmax_l (snd low) (snd high)). pose proof (Rmax_r (snd low) (snd high)).
  destruct M as [M | M].
  - pose proof (M _ _ P ltac:(lra)). pose proof (M x (Rmin hi (snd b)) ltac:(lra) ltac:(lra)). lra.
  - pose proof (M _ _ P ltac:(lra)). pose proof (M x (Rmin hi (snd b)) ltac:(lra) ltac:(lra)). lra.
Qed.

(* ---- tails ---- *)

Lemma exp_above_two n : (0 < n)%nat -> 2 ^ n < exp (INR n).
Proof.
  intros N. induction n as [| n IH]; [lia |]. rewrite S_INR, exp_plus. simpl.
  assert (E : 2 < exp 1) by (pose proof (exp_ineq1 1 ltac:(lra)); lra).
  assert (P : 0 < 2 ^ n) by (apply pow_lt; lra).
  destruct n as [| n]; [simpl in *; rewrite exp_0; lra |]. specialize (IH ltac:(lia)).
  rewrite (Rmult_comm 2). apply Rmult_gt_0_lt_compat; lra.
Qed.

(* exp(x) < 2^-n where x <= -n. *)
Theorem exp_tail n x : (0 < n)%nat -> x <= - INR n -> 0 < exp x < / 2 ^ n.
Proof.
  intros N X. split; [apply exp_pos |]. apply Rle_lt_trans with (exp (- INR n)).
  - destruct (Req_dec x (- INR n)) as [-> | D]; [lra |]. left. apply exp_increasing. lra.
  - rewrite exp_Ropp. apply Rinv_lt_contravar; [| now apply exp_above_two].
    apply Rmult_lt_0_compat; [apply pow_lt; lra | apply exp_pos].
Qed.

(* tanh x is between 1 - 2 exp(-2x) and 1. *)
Theorem tanh_tail x : 1 - 2 * exp (- (2 * x)) < tanh x < 1.
Proof.
  unfold tanh, sinh, cosh. pose proof (exp_pos x) as P. pose proof (exp_pos (- x)) as Q.
  assert (E : exp x * exp (- x) = 1) by (rewrite <- exp_plus, Rplus_opp_r; apply exp_0).
  assert (T : exp (- (2 * x)) = exp (- x) * exp (- x)) by (rewrite <- exp_plus; f_equal; ring).
  replace ((exp x - exp (- x)) / 2 / ((exp x + exp (- x)) / 2)) with (1 - 2 * exp (- x) / (exp x + exp (- x)))
    by (field; lra).
  assert (D : 0 < 2 * exp (- x) / (exp x + exp (- x))) by (apply Rdiv_lt_0_compat; lra).
  split; [| lra]. apply Rplus_lt_compat_l, Ropp_lt_contravar. rewrite T.
  apply (Rmult_lt_reg_r (exp x + exp (- x))); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
  replace (2 * (exp (- x) * exp (- x)) * (exp x + exp (- x)))
    with (2 * exp (- x) * (exp x * exp (- x)) + 2 * (exp (- x) * exp (- x) * exp (- x))) by ring.
  rewrite E. assert (0 < exp (- x) * exp (- x) * exp (- x)) by (repeat apply Rmult_lt_0_compat; assumption). lra.
Qed.

(* Beyond n, tanh is within 2^-n of 1. *)
Theorem tanh_near_one n x : (0 < n)%nat -> INR n <= x -> 1 - / 2 ^ n < tanh x < 1.
Proof.
  intros N X. destruct (tanh_tail x) as [A B]. split; [| exact B].
  destruct (exp_tail n (- x) N ltac:(lra)) as [P Q].
  assert (E : exp (- (2 * x)) = exp (- x) * exp (- x)) by (rewrite <- exp_plus; f_equal; ring).
  assert (H : / 2 ^ n <= / 2).
  { apply Rinv_le_contravar; [lra |]. destruct n as [| n]; [lia |]. simpl.
    pose proof (pow_R1_Rle 2 n ltac:(lra)). lra. }
  assert (2 * (exp (- x) * exp (- x)) <= exp (- x)).
  { assert (exp (- x) * exp (- x) <= exp (- x) * / 2) by (apply Rmult_le_compat_l; lra). lra. }
  lra.
Qed.

(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* How often a closed polygon winds around a point: counted by the sides above it,
  and the same at the end of a motion in
   which the point is never on a side. *)
From Coq Require Import Reals Lra Lia ZArith List Permutation Bool Classical.
From Dyadel Require Import Plane Orientation Path TiedRim.
Open Scope R_scope.

(* ---- sides above a point ---- *)

Definition right (z v : point) : Z := if Rle_dec (fst z) (fst v) then 1%Z else 0%Z.

(* The side from a to b passes above z to the right, to the left, or not. *)
Definition passes (z a b : point) : Z :=
  match right z a, right z b with
  | 0%Z, 1%Z => if Rlt_dec (orient a b z) 0 then 1%Z else 0%Z
  | 1%Z, 0%Z => if Rlt_dec 0 (orient a b z) then (-1)%Z else 0%Z
  | _, _ => 0%Z
  end.

Lemma right_cases z v : (right z v = 1%Z /\ fst z <= fst v) \/ (right z v = 0%Z /\ fst v < fst z).
Proof. unfold right. destruct (Rle_dec (fst z) (fst v)); [now left | right; split; [reflexivity | lra]]. Qed.

Lemma passes_back z a b : passes z b a = (- passes z a b)%Z.
Proof.
  unfold passes.
  assert (E : orient b a z = - orient a b z) by (unfold orient; ring). rewrite E.
  destruct (right_cases z a) as [[-> _] | [-> _]]; destruct (right_cases z b) as [[-> _] | [-> _]]; try reflexivity;
    repeat match goal with |- context [Rlt_dec ?x ?y] => destruct (Rlt_dec x y) end; try reflexivity; exfalso; lra.
Qed.

(* Where the side is above z when it passes, and where it is below. *)
Lemma passes_above z a b : (fst a < fst z <= fst b -> orient a b z < 0) -> (fst b < fst z <= fst a ->
  0 < orient a b z) ->
  passes z a b = (right z b - right z a)%Z.
Proof.
  intros U D. unfold passes.
  destruct (right_cases z a) as [[-> A] | [-> A]]; destruct (right_cases z b) as [[-> C] | [-> C]]; try reflexivity.
  - destruct (Rlt_dec 0 (orient a b z)) as [_ | N]; [reflexivity | elim N; now apply D].
  - destruct (Rlt_dec (orient a b z) 0) as [_ | N]; [reflexivity | elim N; now apply U].
Qed.

Lemma passes_below z a b : (fst a < fst z <= fst b -> 0 <= orient a b z) -> (fst b < fst z <= fst a ->
  orient a b z <= 0) ->
  passes z a b = 0%Z.
Proof.
  intros U D. unfold passes.
  destruct (right_cases z a) as [[-> A] | [-> A]]; destruct (right_cases z b) as [[-> C] | [-> C]]; try reflexivity.
  - destruct (Rlt_dec 0 (orient a b z)) as [Y | _]; [| reflexivity]. specialize (D (conj C A)). lra.
  - destruct (Rlt_dec (orient a b z) 0) as [Y | _]; [| reflexivity]. specialize (U (conj A C)). lra.
Qed.

(* Both ends above z, or both below. *)
Lemma orient_heights a b z : orient a b z =
  - ((fst b - fst z) * (snd a - snd z) + (fst z - fst a) * (snd b - snd z)).
Proof. unfold orient. ring. Qed.

Lemma ends_above z a b : snd z < snd a -> snd z < snd b -> passes z a b = (right z b - right z a)%Z.
Proof.
  intros A C. apply passes_above; intros [X Y]; rewrite orient_heights.
  - assert (0 < (fst z - fst a) * (snd b - snd z)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= (fst b - fst z) * (snd a - snd z)) by (apply Rmult_le_pos; lra). lra.
  - assert (0 < (fst z - fst b) * (snd a - snd z)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= (fst a - fst z) * (snd b - snd z)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma ends_below z a b : snd a < snd z -> snd b < snd z -> passes z a b = 0%Z.
Proof.
  intros A C. apply passes_below; intros [X Y]; rewrite orient_heights.
  - assert (0 <= (fst z - fst a) * (snd z - snd b)) by (apply Rmult_le_pos; lra).
    assert (0 <= (fst b - fst z) * (snd z - snd a)) by (apply Rmult_le_pos; lra). lra.
  - assert (0 <= (fst z - fst b) * (snd z - snd a)) by (apply Rmult_le_pos; lra).
    assert (0 <= (fst a - fst z) * (snd z - snd b)) by (apply Rmult_le_pos; lra). lra.
Qed.

(* ---- a side and a point that move ---- *)

Lemma near_less u v t : continuity u -> continuity v -> u t < v t -> near t (fun s => u s < v s).
Proof.
  intros U V L. assert (P : 0 < v t - u t) by lra.
  generalize (near_positive (fun s => v s - u s) t (continuity_minus v u V U) P). apply near_weaken. intros s S. lra.
Qed.

Definition moves (v : R -> point) : Prop := continuity (fun s => fst (v s)) /\ continuity (fun s => snd (v s)).

Section Side.
Variables (z : R -> point) (t : R).
Variable move_z : moves z.

(* 1 for a point straight above z at the time t and to its right at s. *)
Definition above (v : R -> point) (s : R) : Z :=
  if Req_EM_T (fst (v t)) (fst (z t)) then if Rlt_dec (snd (z t)) (snd (v t)) then right (z s) (v s) else 0%Z else 0%Z.

Lemma near_right v : continuity (fun s => fst (v s)) -> fst (v t) <> fst (z t) ->
  near t (fun s => right (z s) (v s) = right (z t) (v t)).
Proof.
  intros V D. destruct (Rlt_dec (fst (v t)) (fst (z t))) as [L | L].
  - generalize (near_less _ _ t V (proj1 move_z) L). apply near_weaken.
    intros s S. unfold right. destruct (Rle_dec (fst (z s)) (fst (v s))); [lra |].
    destruct (Rle_dec (fst (z t)) (fst (v t))); [lra | reflexivity].
  - assert (G : fst (z t) < fst (v t)) by lra. generalize (near_less _ _ t (proj1 move_z) V G). apply near_weaken.
    intros s S. unfold right. destruct (Rle_dec (fst (z s)) (fst (v s))); [| lra].
    destruct (Rle_dec (fst (z t)) (fst (v t))); [reflexivity | lra].
Qed.

Lemma turn_continuous a b : moves a -> moves b -> continuity (fun s => orient (a s) (b s) (z s)).
Proof.
  intros [] []. unfold orient. destruct move_z.
  apply (continuity_minus (fun s => (fst (b s) - fst (a s)) * (snd (z s) - snd (a s)))
    (fun s => (snd (b s) - snd (a s)) * (fst (z s) - fst (a s))));
  [apply (continuity_mult (fun s => fst (b s) - fst (a s)) (fun s => snd (z s) - snd (a s))) |
   apply (continuity_mult (fun s => snd (b s) - snd (a s)) (fun s => fst (z s) - fst (a s)))];
  match goal with |- continuity (fun s => ?f - ?g) => apply (continuity_minus (fun s => f) (fun s => g)) end;
    assumption.
Qed.

(* What the side counts changes only by what its ends do straight above z: where one end is straight above or below it. *)
Definition steady (a b : R -> point) : Prop := near t (fun s => (passes (z s) (a s) (b s) - (above b s - above a s) =
  passes (z t) (a t) (b t) - (above b t - above a t))%Z).

Lemma end_steady a b : moves a -> moves b -> ~ between (z t) (a t) (b t) -> fst (a t) = fst (z t) ->
  fst (b t) <> fst (z t) -> steady a b.
Proof.
  intros Ma Mb off Ea Eb. pose proof (turn_continuous a b Ma Mb) as Turn. destruct Mb as [Bx _], move_z as [Zx _].
  pose proof (near_right b Bx Eb) as Kb.
  assert (NotA : snd (a t) <> snd (z t)).
  { intros F. apply off. exists 0. split; [lra |]. rewrite mix_0. symmetry.
    rewrite (surjective_pairing (a t)), (surjective_pairing (z t)). now f_equal. }
  unfold steady, above. destruct (Req_EM_T (fst (a t)) (fst (z t))) as [_ | N]; [| now elim N].
  destruct (Req_EM_T (fst (b t)) (fst (z t))) as [N | _]; [now elim Eb |].
  assert (O : orient (a t) (b t) (z t) = (fst (b t) - fst (z t)) * (snd (z t) - snd (a t)))
    by (rewrite orient_heights, Ea; ring).
  destruct (Rlt_dec (fst (z t)) (fst (b t))) as [Rb | Rb];
    destruct (Rlt_dec (snd (z t)) (snd (a t))) as [Ua | Ua].
  + assert (Q : orient (a t) (b t) (z t) < 0) by (rewrite O; nra).
    generalize (near_and _ _ _ Kb (near_and _ _ _ (near_negative _ t Turn Q)
      (near_less _ _ t Zx Bx ltac:(lra)))). apply near_weaken. intros s [K [C D]].
    rewrite (passes_above (z s)), (passes_above (z t)); try (intros [X Y]; lra). rewrite K. lia.
  + assert (Q : 0 < orient (a t) (b t) (z t)) by (rewrite O; apply Rmult_lt_0_compat; lra).
    generalize (near_and _ _ _ (near_positive _ t Turn Q)
      (near_less _ _ t Zx Bx ltac:(lra))). apply near_weaken. intros s [C D].
    rewrite (passes_below (z s)), (passes_below (z t)); try (intros [X Y]; lra). lia.
  + assert (Q : 0 < orient (a t) (b t) (z t)) by (rewrite O; nra).
    generalize (near_and _ _ _ Kb (near_and _ _ _ (near_positive _ t Turn Q)
      (near_less _ _ t Bx Zx ltac:(lra)))). apply near_weaken. intros s [K [C D]].
    rewrite (passes_above (z s)), (passes_above (z t)); try (intros [X Y]; lra). rewrite K. lia.
  + assert (Q : orient (a t) (b t) (z t) < 0) by (rewrite O; nra).
    generalize (near_and _ _ _ (near_negative _ t Turn Q)
      (near_less _ _ t Bx Zx ltac:(lra))). apply near_weaken. intros s [C D].
    rewrite (passes_below (z s)), (passes_below (z t)); try (intros [X Y]; lra). lia.
Qed.
(* The same wherever they are. *)
Lemma side_steady a b : moves a -> moves b -> ~ between (z t) (a t) (b t) -> steady a b.
Proof.
  intros Ma Mb off. pose proof (turn_continuous a b Ma Mb) as Turn. pose proof Ma as [Ax Ay]. pose proof Mb as [Bx By].
  destruct move_z as [Zx Zy].
  assert (Up : forall v : R -> point, continuity (fun s => snd (v s)) -> snd (z t) < snd (v t) ->
    near t (fun s => snd (z s) < snd (v s)))
    by (intros v V L; exact (near_less _ _ t Zy V L)).
  assert (Down : forall v : R -> point, continuity (fun s => snd (v s)) -> snd (v t) < snd (z t) ->
    near t (fun s => snd (v s) < snd (z s)))
    by (intros v V L; exact (near_less _ _ t V Zy L)).
  assert (NotA : fst (a t) = fst (z t) -> snd (a t) <> snd (z t)).
  { intros E F. apply off. exists 0. split; [lra |]. rewrite mix_0. symmetry.
    rewrite (surjective_pairing (a t)), (surjective_pairing (z t)). now f_equal. }
  assert (NotB : fst (b t) = fst (z t) -> snd (b t) <> snd (z t)).
  { intros E F. apply off. exists 1. split; [lra |]. rewrite mix_1. symmetry.
    rewrite (surjective_pairing (b t)), (surjective_pairing (z t)). now f_equal. }
  destruct (Req_EM_T (fst (a t)) (fst (z t))) as [Ea | Ea]; destruct (Req_EM_T (fst (b t)) (fst (z t))) as [Eb | Eb].
  - specialize (NotA Ea). specialize (NotB Eb). unfold steady, above.
    destruct (Req_EM_T (fst (a t)) (fst (z t))) as [_ | N]; [| now elim N].
    destruct (Req_EM_T (fst (b t)) (fst (z t))) as [_ | N]; [| now elim N].
    destruct (Rlt_dec (snd (z t)) (snd (a t))) as [Ua | Ua]; destruct (Rlt_dec (snd (z t)) (snd (b t))) as [Ub | Ub];
      [| exfalso; apply off .. |]; try (set (r := (snd (a t) - snd (z t)) / (snd (a t) - snd (b t)));
        assert (R1 : r * (snd (a t) - snd (b t)) = snd (a t) - snd (z t)) by (unfold r; field; lra);
        exists r; split; [split; nra |]; rewrite (surjective_pairing (z t)); unfold mix; rewrite Ea, Eb; f_equal; lra).
    + generalize (near_and _ _ _ (Up a Ay Ua) (Up b By Ub)). apply near_weaken. intros s [A C].
      rewrite (ends_above _ _ _ A C), (ends_above _ _ _ Ua Ub). lia.
    + generalize (near_and _ _ _ (Down a Ay ltac:(lra)) (Down b By ltac:(lra))). apply near_weaken. intros s [A C].
      rewrite (ends_below _ _ _ A C), (ends_below (z t) (a t) (b t)) by lra. lia.
  - now apply end_steady.
  - assert (Back : ~ between (z t) (b t) (a t)).
    { intros [u [U E]]. apply off. exists (1 - u). split; [lra |]. rewrite E. apply mix_swap. }
    generalize (end_steady b a Mb Ma Back Eb Ea). apply near_weaken. intros s K.
    rewrite !(passes_back _ (a _) (b _)) in K. lia.
  - pose proof (near_right a Ax Ea) as Ka. pose proof (near_right b Bx Eb) as Kb. unfold steady, above.
    destruct (Req_EM_T (fst (a t)) (fst (z t))) as [N | _]; [now elim Ea |].
    destruct (Req_EM_T (fst (b t)) (fst (z t))) as [N | _]; [now elim Eb |].
    assert (Same : right (z t) (a t) = right (z t) (b t) \/ orient (a t) (b t) (z t) <> 0).
    { destruct (right_cases (z t) (a t)) as [[-> A] | [-> A]]; destruct (right_cases (z t) (b t)) as [[-> C] | [-> C]];
        try (now left); right; intros O; apply off;
        set (r := (fst (z t) - fst (a t)) / (fst (b t) - fst (a t)));
        assert (R1 : r * (fst (b t) - fst (a t)) = fst (z t) - fst (a t)) by (unfold r; field; lra);
        (exists r; split; [split; nra |]); rewrite (surjective_pairing (z t)); unfold mix; (f_equal; [lra |]);
        apply (Rmult_eq_reg_r (fst (b t) - fst (a t))); try lra; unfold orient in O;
        transitivity (snd (a t) * (fst (b t) - fst (a t)) + (snd (b t) - snd (a t)) * (r * (fst (b t) - fst (a t))));
        (rewrite R1; lra) || ring. }
    destruct Same as [Same | O].
    + generalize (near_and _ _ _ Ka Kb). apply near_weaken. intros s [A C]. unfold passes. rewrite A, C, Same.
      destruct (right_cases (z t) (b t)) as [[-> _] | [-> _]]; reflexivity.
    + destruct (Rlt_dec (orient (a t) (b t) (z t)) 0) as [N | P].
      * generalize (near_and _ _ _ (near_negative _ t Turn N) (near_and _ _ _ Ka Kb)). apply near_weaken.
        intros s [Q [A C]]. unfold passes. rewrite A, C.
        destruct (Rlt_dec (orient (a s) (b s) (z s)) 0); [| lra]. destruct (Rlt_dec (orient (a t) (b t) (z t)) 0);
          [| lra].
        destruct (Rlt_dec 0 (orient (a s) (b s) (z s))); [lra |]. destruct (Rlt_dec 0 (orient (a t) (b t) (z t)));
          [lra |].
        reflexivity.
      * generalize (near_and _ _ _ (near_positive _ t Turn ltac:(lra)) (near_and _ _ _ Ka Kb)).
        apply near_weaken. intros s [Q [A C]]. unfold passes. rewrite A, C.
        destruct (Rlt_dec (orient (a s) (b s) (z s)) 0); [lra |]. destruct (Rlt_dec (orient (a t) (b t) (z t)) 0);
          [lra |].
        destruct (Rlt_dec 0 (orient (a s) (b s) (z s))); [| lra]. destruct (Rlt_dec 0 (orient (a t) (b t) (z t)));
          [| lra].
        reflexivity.
Qed.
End Side.

(* ---- closed polygons ---- *)

Definition total (c : nat -> nat -> Z) (E : list (nat * nat)) : Z :=
  fold_right (fun e s => (c (fst e) (snd e) + s)%Z) 0%Z E.
Definition closed (E : list (nat * nat)) : Prop := forall g : nat -> Z, total (fun a b => (g b - g a)%Z) E = 0%Z.

Lemma total_app c E F : total c (E ++ F) = (total c E + total c F)%Z.
Proof. unfold total. induction E as [| e E IH]; simpl; [reflexivity |]. rewrite IH. lia. Qed.

Lemma total_permuted c E F : Permutation E F -> total c E = total c F.
Proof. intros P. unfold total. induction P; simpl; lia. Qed.

Lemma total_same c d E : (forall a b, In (a, b) E -> c a b = d a b) -> total c E = total d E.
Proof.
  unfold total. induction E as [| [a b] E IH]; intros H; simpl; [reflexivity |].
  rewrite IH by (intros x y X; apply H; now right). rewrite (H a b); [reflexivity | now left].
Qed.

Lemma total_minus c d E : total (fun a b => (c a b - d a b)%Z) E = (total c E - total d E)%Z.
Proof. unfold total. induction E as [| e E IH]; simpl; [reflexivity |]. rewrite IH. lia. Qed.

(* Times at which a closed polygon winds as often around the point: all, if the point is never on a side. *)
Theorem winding_steady E (p : nat -> R -> point) (z : R -> point) : closed E ->
  (forall v, continuity (fun s => fst (p v s)) /\ continuity (fun s => snd (p v s))) ->
  continuity (fun s => fst (z s)) /\ continuity (fun s => snd (z s)) ->
  (forall t a b, 0 <= t <= 1 -> In (a, b) E -> ~ between (z t) (p a t) (p b t)) ->
  total (fun a b => passes (z 1) (p a 1) (p b 1)) E = total (fun a b => passes (z 0) (p a 0) (p b 0)) E.
Proof.
  intros C Mp Mz Off. set (W := fun s => total (fun a b => passes (z s) (p a s) (p b s)) E).
  assert (Near : forall t, 0 <= t <= 1 -> near t (fun s => W s = W t)).
  { intros t T.
    assert (K : near t (fun s => forall e, In e E ->
      (passes (z s) (p (fst e) s) (p (snd e) s) - (above z t (p (snd e)) s - above z t (p (fst e)) s) =
       passes (z t) (p (fst e) t) (p (snd e) t) - (above z t (p (snd e)) t - above z t (p (fst e)) t))%Z)).
    { apply near_list. intros [a b] F. simpl. exact (side_steady z t Mz (p a) (p b) (Mp a) (Mp b) (Off t a b T F)). }
    revert K. apply near_weaken. intros s K.
    assert (Sum : forall r, (W r = total (fun a b => passes (z r) (p a r) (p b r) - (above z t (p b) r - above z t (p
      a) r)) E)%Z).
    { intros r. rewrite (total_minus (fun a b => passes (z r) (p a r) (p b r)) (fun a b => above z t (p b) r - above z
      t (p a) r)%Z).
      rewrite (C (fun v => above z t (p v) r)). unfold W. lia. }
    rewrite (Sum s), (Sum t). apply total_same. intros a b F. exact (K (a, b) F). }
  apply (open_closed (fun t => W t = W 0)); [reflexivity | |].
  - intros t T Q. destruct (Near t T) as [e [E0 K]]. exists e. split; [exact E0 |]. intros s S _. now rewrite (K s S).
  - intros t T Q. destruct (Near t T) as [e [E0 K]]. exists e. split; [exact E0 |]. intros s S _. now rewrite (K s S).
Qed.

(* ---- polygons made of triangles ---- *)

Definition sides (t : nat * nat * nat) : list (nat * nat) := let '(a, b, c) := t in (a, b) :: (b, c) :: (c, a) :: nil.
Definition both (e : nat * nat) : list (nat * nat) := e :: (snd e, fst e) :: nil.

(* The sides of the triangles T are those of the rim E, and the inner ones, in both directions. *)
Definition rim_of (T : list (nat * nat * nat)) (E : list (nat * nat)) : Prop :=
  exists I, Permutation (flat_map sides T) (E ++ flat_map both I).

Lemma rim_total c T E : (forall a b, c b a = (- c a b)%Z) -> rim_of T E -> total c E = total c (flat_map sides T).
Proof.
  intros O [I P]. rewrite (total_permuted c _ _ P), total_app.
  assert (Z : total c (flat_map both I) = 0%Z); [| lia].
  clear P. induction I as [| [a b] I IH]; [reflexivity |]. simpl flat_map. unfold total in *. simpl. rewrite IH,
    (O a b). lia.
Qed.

Lemma rim_closed T E : rim_of T E -> closed E.
Proof.
  intros R g. rewrite (rim_total _ T E); [| intros; lia | exact R].
  clear R. induction T as [| [[a b] c] T IH]; [reflexivity |]. simpl flat_map. unfold total in *. simpl. rewrite IH.
    lia.
Qed.

(* Around a point that is not in a triangle, it does not wind. *)
Lemma one_left z a b c : fst a < fst z -> fst z <= fst b -> fst z <= fst c -> 0 < orient a b c ->
  ~ (0 <= orient a b z /\ 0 <= orient b c z /\ 0 <= orient c a z) -> (orient a b z < 0 <-> 0 < orient c a z).
Proof.
  intros A B C D N.
  assert (E : (fst z - fst a) * orient a b c = (fst c - fst a) * orient a b z + (fst b - fst a) * orient c a z)
    by (unfold orient; ring).
  assert (S : orient b c z + orient c a z + orient a b z = orient a b c) by (unfold orient; ring).
  assert (X : orient a b c * fst z = orient b c z * fst a + orient c a z * fst b + orient a b z * fst c)
    by (unfold orient; ring).
  assert (P : 0 < (fst z - fst a) * orient a b c) by (apply Rmult_lt_0_compat; lra). split; intros Q.
  - apply Rnot_le_lt. intros L. assert (0 < (fst c - fst a) * - orient a b z) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= (fst b - fst a) * - orient c a z) by (apply Rmult_le_pos; lra). lra.
  - apply Rnot_le_lt. intros L. apply N. split; [lra |]. split; [| lra]. apply Rnot_lt_le. intros M.
    assert (0 <= orient c a z * (fst b - fst z)) by (apply Rmult_le_pos; lra).
    assert (0 <= orient a b z * (fst c - fst z)) by (apply Rmult_le_pos; lra).
    assert (0 < - orient b c z * (fst z - fst a)) by (apply Rmult_lt_0_compat; lra).
    assert (orient a b c * fst z = (orient b c z + orient c a z + orient a b z) * fst z) by (rewrite S; ring). nra.
Qed.

Lemma one_right z a b c : fst z <= fst a -> fst b < fst z -> fst c < fst z -> 0 < orient a b c ->
  ~ (0 <= orient a b z /\ 0 <= orient b c z /\ 0 <= orient c a z) -> (0 < orient a b z <-> orient c a z < 0).
Proof.
  intros A B C D N.
  assert (E : (fst a - fst z) * orient a b c = (fst a - fst c) * orient a b z + (fst a - fst b) * orient c a z)
    by (unfold orient; ring).
  assert (S : orient b c z + orient c a z + orient a b z = orient a b c) by (unfold orient; ring).
  assert (X : orient a b c * fst z = orient b c z * fst a + orient c a z * fst b + orient a b z * fst c)
    by (unfold orient; ring).
  assert (P : 0 <= (fst a - fst z) * orient a b c) by (apply Rmult_le_pos; lra).
  assert (X0 : orient b c z * (fst a - fst z) = orient c a z * (fst z - fst b) + orient a b z * (fst z - fst c)).
  { assert (orient a b c * fst z = (orient b c z + orient c a z + orient a b z) * fst z) by (rewrite S; ring). lra. }
  split; intros Q.
  - apply Rnot_le_lt. intros L. apply N. split; [lra |]. split; [| lra]. apply Rnot_lt_le. intros M.
    assert (0 <= orient c a z * (fst z - fst b)) by (apply Rmult_le_pos; lra).
    assert (0 < orient a b z * (fst z - fst c)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= - orient b c z * (fst a - fst z)) by (apply Rmult_le_pos; lra). nra.
  - apply Rnot_le_lt. intros L. assert (0 <= (fst a - fst c) * - orient a b z) by (apply Rmult_le_pos; lra).
    assert (0 < (fst a - fst b) * - orient c a z) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma triangle_around z a b c : 0 < orient a b c ->
  ~ (0 <= orient a b z /\ 0 <= orient b c z /\ 0 <= orient c a z) ->
  (passes z a b + passes z b c + passes z c a = 0)%Z.
Proof.
  intros D N.
  assert (D1 : 0 < orient b c a) by (unfold orient in *; lra). assert (D2 : 0 < orient c a b) by (unfold orient in *;
    lra).
  assert (N1 : ~ (0 <= orient b c z /\ 0 <= orient c a z /\ 0 <= orient a b z)) by tauto.
  assert (N2 : ~ (0 <= orient c a z /\ 0 <= orient a b z /\ 0 <= orient b c z)) by tauto.
  unfold passes.
  destruct (right_cases z a) as [[-> A] | [-> A]]; destruct (right_cases z b) as [[-> B] | [-> B]];
    destruct (right_cases z c) as [[-> C] | [-> C]]; try reflexivity.
  - pose proof (one_left z c a b C A B D2 N2) as Q. destruct (Rlt_dec 0 (orient b c z)), (Rlt_dec (orient c a z) 0);
      try reflexivity; exfalso; tauto.
  - pose proof (one_left z b c a B C A D1 N1) as Q. destruct (Rlt_dec 0 (orient a b z)), (Rlt_dec (orient b c z) 0);
      try reflexivity; exfalso; tauto.
  - pose proof (one_right z a b c A B C D N) as Q. destruct (Rlt_dec 0 (orient a b z)), (Rlt_dec (orient c a z) 0);
      try reflexivity; exfalso; tauto.
  - pose proof (one_left z a b c A B C D N) as Q. destruct (Rlt_dec (orient a b z) 0), (Rlt_dec 0 (orient c a z));
      try reflexivity; exfalso; tauto.
  - pose proof (one_right z b c a B C A D1 N1) as Q. destruct (Rlt_dec (orient a b z) 0), (Rlt_dec 0 (orient b c z));
      try reflexivity; exfalso; tauto.
  - pose proof (one_right z c a b C A B D2 N2) as Q. destruct (Rlt_dec (orient b c z) 0), (Rlt_dec 0 (orient c a z));
      try reflexivity; exfalso; tauto.
Qed.

Theorem rim_around T E (p : nat -> point) z : rim_of T E ->
  (forall a b c, In (a, b, c) T -> 0 < orient (p a) (p b) (p c) /\
    ~ (0 <= orient (p a) (p b) z /\ 0 <= orient (p b) (p c) z /\ 0 <= orient (p c) (p a) z)) ->
  total (fun a b => passes z (p a) (p b)) E = 0%Z.
Proof.
  intros R H. rewrite (rim_total _ T E); [| intros a b; apply passes_back | exact R].
  clear R. induction T as [| [[a b] c] T IH]; [reflexivity |]. simpl flat_map.
  destruct (H a b c (or_introl eq_refl)) as [D N]. pose proof (triangle_around z _ _ _ D N) as Q.
  unfold total in *. simpl. rewrite IH by (intros x y w X; apply H; now right). lia.
Qed.

(* ---- the points on the left of all sides ---- *)

(* Before in the order of directions from straight down counterclockwise to straight up, on the right of 0. *)
Definition before (x y : point) : Prop :=
  0 < fst x * snd y - snd x * fst y \/ (fst x = 0 /\ fst y = 0 /\ snd x < 0 < snd y).

Lemma before_trans x y w : 0 <= fst x -> 0 <= fst y -> 0 <= fst w -> before x y -> before y w -> before x w.
Proof.
  intros X Y W [A | [A1 [A2 A3]]] [C | [C1 [C2 C3]]].
  - assert (Y0 : 0 < fst y).
    { apply Rnot_le_lt. intros L. assert (Z : fst y = 0) by lra. rewrite Z in A, C.
      assert (0 < snd y) by (apply Rnot_le_lt; intros M; assert (0 <= fst x * - snd y) by (apply Rmult_le_pos; lra);
        lra).
      assert (0 <= snd y * fst w) by (apply Rmult_le_pos; lra). lra. }
    assert (E : fst y * (fst x * snd w - snd x * fst w) =
      fst w * (fst x * snd y - snd x * fst y) + fst x * (fst y * snd w - snd y * fst w)) by ring.
    assert (P1 : 0 <= fst w * (fst x * snd y - snd x * fst y)) by (apply Rmult_le_pos; lra).
    assert (P2 : 0 <= fst x * (fst y * snd w - snd y * fst w)) by (apply Rmult_le_pos; lra).
    destruct (Req_dec (fst w) 0) as [Zw | Zw]; [destruct (Req_dec (fst x) 0) as [Zx | Zx] |].
    + right. rewrite Zx in A. rewrite Zw in C. repeat split; [exact Zx | exact Zw | nra | nra].
    + left. apply (Rmult_lt_reg_l (fst y)); [exact Y0 |]. rewrite E.
      assert (0 < fst x * (fst y * snd w - snd y * fst w)) by (apply Rmult_lt_0_compat; lra). lra.
    + left. apply (Rmult_lt_reg_l (fst y)); [exact Y0 |]. rewrite E.
      assert (0 < fst w * (fst x * snd y - snd x * fst y)) by (apply Rmult_lt_0_compat; lra). lra.
  - exfalso. rewrite C1 in A. assert (0 <= fst x * - snd y) by (apply Rmult_le_pos; lra). lra.
  - exfalso. rewrite A2 in C. assert (0 <= snd y * fst w) by (apply Rmult_le_pos; lra). lra.
  - exfalso. lra.
Qed.

Lemma before_self x : ~ before x x.
Proof. intros [A | [_ [_ A]]]; [replace (fst x * snd x - snd x * fst x) with 0 in A by ring |]; lra. Qed.

Lemma all_zero c E : (forall a b, In (a, b) E -> (0 <= c a b)%Z) -> total c E = 0%Z -> forall a b, In (a, b) E ->
  c a b = 0%Z.
Proof.
  unfold total. induction E as [| [x y] E IH]; intros P Z a b F; [destruct F |]. simpl in Z.
  assert (Q : forall l, (forall a b, In (a, b) l -> (0 <= c a b)%Z) ->
    (0 <= fold_right (fun e s => c (fst e) (snd e) + s) 0 l)%Z).
  { induction l as [| [u v] l IHl]; intros R; simpl; [lia |]. pose proof (R u v (or_introl eq_refl)).
    specialize (IHl ltac:(intros; apply R; now right)). lia. }
  specialize (Q E ltac:(intros; apply P; now right)). pose proof (P x y (or_introl eq_refl)).
  destruct F as [F | F]; [injection F as <- <-; lia |]. apply IH; [intros; apply P; now right | lia | exact F].
Qed.

Lemma total_opposite c E : total (fun a b => (- c a b)%Z) E = (- total c E)%Z.
Proof. unfold total. induction E as [| e E IH]; simpl; [reflexivity |]. rewrite IH. lia. Qed.

Section Left.
Variables (E : list (nat * nat)) (p : nat -> point) (z : point).
Variable loop : closed E.
Variable inside_all : forall a b, In (a, b) E -> 0 < orient (p a) (p b) z.

Definition from_z (s : R) (v : nat) : point := (s * (fst (p v) - fst z), s * (snd (p v) - snd z)).
Definition beforeb (x y : point) : bool :=
  if Rlt_dec 0 (fst x * snd y - snd x * fst y) then true else
  if Req_EM_T (fst x) 0 then if Req_EM_T (fst y) 0 then if Rlt_dec (snd x) 0 then if Rlt_dec 0 (snd y) then true
  else false else false else false else false.

Lemma beforeb_true x y : beforeb x y = true <-> before x y.
Proof.
  unfold beforeb, before. destruct (Rlt_dec 0 (fst x * snd y - snd x * fst y)); [tauto |].
  destruct (Req_EM_T (fst x) 0), (Req_EM_T (fst y) 0), (Rlt_dec (snd x) 0), (Rlt_dec 0 (snd y));
    split; intros H; try discriminate; try reflexivity; try tauto; destruct H as [H | H]; try contradiction; lra.
Qed.

Lemma no_side s k : s * s = 1 -> (forall v, right z v = k -> 0 <= s * (fst v - fst z)) ->
  (forall a b, In (a, b) E -> right z (p a) = right z (p b)) -> forall a b, In (a, b) E -> right z (p a) <> k.
Proof.
  intros S K Same.
  set (f := fun v w => Z.eqb (right z (p w)) k && beforeb (from_z s w) (from_z s v)).
  set (g := fun v => if Z.eqb (right z (p v)) k then Z.of_nat (length (filter (f v) (map fst E))) else 0%Z).
  assert (Up : forall a b, In (a, b) E -> right z (p a) = k -> (g a < g b)%Z).
  { intros a b F Q. pose proof (Same a b F) as Eq. unfold g. rewrite <- Eq, Q, Z.eqb_refl. apply Nat2Z.inj_lt.
    assert (P : before (from_z s a) (from_z s b)).
    { left. unfold from_z. simpl. pose proof (inside_all a b F) as I.
      replace (_ - _) with (s * s * orient (p a) (p b) z) by (unfold orient; ring). rewrite S. lra. }
    assert (Fst : forall v, right z (p v) = k -> 0 <= fst (from_z s v)) by (intros v V; simpl; now apply K).
    apply fewer with (x := a).
    - intros y Y. unfold f in *. apply andb_prop in Y as [Y1 Y2]. rewrite Y1. simpl. apply Z.eqb_eq in Y1.
      apply beforeb_true in Y2. apply beforeb_true. apply before_trans with (from_z s a); auto. apply Fst. congruence.
    - apply in_map_iff. now exists (a, b).
    - unfold f. rewrite Q, Z.eqb_refl. simpl. now apply beforeb_true.
    - unfold f. rewrite Q, Z.eqb_refl. simpl. destruct (beforeb _ _) eqn:W; [| reflexivity].
      apply beforeb_true in W. now apply before_self in W. }
  intros a b F Q. assert (Z0 : (g b - g a)%Z = 0%Z).
  { apply (all_zero (fun a b => (g b - g a)%Z) E); [| apply loop | exact F]. intros x y G.
    destruct (Z.eq_dec (right z (p x)) k) as [W | W]; [specialize (Up x y G W); lia |].
    unfold g. rewrite <- (Same x y G). apply Z.eqb_neq in W. rewrite W. lia. }
  specialize (Up a b F Q). lia.
Qed.

(* A closed polygon with a point on the left of all its sides winds around it. *)
Theorem winds_around : total (fun a b => passes z (p a) (p b)) E = 0%Z -> E = nil.
Proof.
  intros Z0.
  assert (Cases : forall a b, In (a, b) E -> (passes z (p a) (p b) <= 0)%Z /\
    (passes z (p a) (p b) = 0%Z -> (0 <= right z (p b) - right z (p a))%Z)).
  { intros a b F. pose proof (inside_all a b F) as I. unfold passes.
    destruct (right_cases z (p a)) as [[-> _] | [-> _]]; destruct (right_cases z (p b)) as [[-> _] | [-> _]]; try lia.
    - destruct (Rlt_dec 0 (orient (p a) (p b) z)); [lia | lra].
    - destruct (Rlt_dec (orient (p a) (p b) z) 0); [lra | lia]. }
  assert (None : forall a b, In (a, b) E -> passes z (p a) (p b) = 0%Z).
  { intros a b F. assert (Q : (- passes z (p a) (p b))%Z = 0%Z); [| lia].
    apply (all_zero (fun a b => (- passes z (p a) (p b))%Z) E); [| | exact F].
    - intros x y G. pose proof (proj1 (Cases x y G)). lia.
    - rewrite (total_opposite (fun a b => passes z (p a) (p b))), Z0. reflexivity. }
  assert (Same : forall a b, In (a, b) E -> right z (p a) = right z (p b)).
  { intros a b F. assert (Q : (right z (p b) - right z (p a))%Z = 0%Z); [| lia].
    apply (all_zero (fun a b => (right z (p b) - right z (p a))%Z) E);
      [| apply (loop (fun v => right z (p v))) | exact F].
    intros x y G. apply (Cases x y G). now apply None. }
  destruct E as [| [a b] l] eqn:Es; [reflexivity |]. exfalso.
  assert (F : In (a, b) E) by (rewrite Es; now left). rewrite <- Es in *.
  destruct (right_cases z (p a)) as [[Q _] | [Q _]].
  - apply (no_side 1 1) with a b; auto; [ring |]. intros v V. destruct (right_cases z v) as [[_ X] | [X _]];
      [lra | congruence].
  - apply (no_side (-1) 0) with a b; auto; [ring |]. intros v V. destruct (right_cases z v) as [[X _] | [_ X]];
      [congruence | lra].
Qed.
End Left.

(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What the faces found by the checker prove: a site that is surrounded has no possible pairs but its spokes, which are
   legal. If all sites are surrounded, the legal pairs listed are all possible pairs. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Crossing Path Fan Checker CheckerSound CheckerFaces.
Import ListNotations.
Open Scope R_scope.

(* ---- lists of pairs, and a ring of directions ---- *)

Section Ring.
Open Scope Z_scope.
Variables (s : Z -> Z) (c : Z -> Z -> Z).
Variable exchange : forall i j k, c i k * s j = c i j * s k + c j k * s i.
Variable same : forall i, c i i = 0.

Lemma in_pairs_cons x l f : In f (pairs l) -> In f (pairs (x :: l)).
Proof. destruct l as [| y l]; [now simpl | intros H; now right]. Qed.

Lemma in_pairs_after l m f : In f (pairs m) -> In f (pairs (l ++ m)).
Proof. intros H. induction l as [| x l IH]; [exact H |]. now apply in_pairs_cons. Qed.

Lemma in_pairs_before l m f : In f (pairs l) -> In f (pairs (l ++ m)).
Proof.
  induction l as [| x l IH]; [now simpl |]. destruct l as [| y l]; [now simpl |]. intros [<- | H]; [now left |].
  right. now apply IH.
Qed.

Lemma sign_change l x y : 0 <= s x -> s y <= 0 ->
  exists i j, In (i, j) (pairs (x :: l ++ [y])) /\ 0 <= s i /\ s j <= 0.
Proof.
  revert x. induction l as [| z l IH]; intros x X Y.
  - exists x, y. split; [now left | now split].
  - destruct (Z_le_gt_dec (s z) 0) as [G | G].
    + exists x, z. split; [now left | now split].
    + destruct (IH z) as [i [j [H K]]]; [lia | exact Y |]. exists i, j. split; [now right | exact K].
Qed.

Lemma no_turn x l b : 0 < s x -> 0 < s b -> b = x \/ 0 < c x b -> (forall z, In z l -> 0 < s z) ->
  ~ (forall i j, In (i, j) (pairs (b :: l ++ [x])) -> 0 < c i j).
Proof.
  intros X. revert b. induction l as [| z l IH]; intros b B S L H.
  - assert (P : 0 < c b x) by (apply H; now left). destruct S as [-> | S].
    + rewrite same in P. lia.
    + pose proof (exchange x b x) as Q. rewrite same in Q. nia.
  - assert (P : 0 < c b z) by (apply H; now left). assert (Z0 : 0 < s z) by (apply L; now left).
    apply (IH z Z0).
    + right. destruct S as [-> | S]; [exact P |]. pose proof (exchange x b z) as Q. nia.
    + intros w W. apply L. now right.
    + intros i j I. apply H. now right.
Qed.
End Ring.

Section Around.
Open Scope Z_scope.
Variables (s : Z -> Z) (c : Z -> Z -> Z).
Variable exchange : forall i j k, c i k * s j = c i j * s k + c j k * s i.
Variable same : forall i, c i i = 0.

Lemma some_or_all (P : Z -> bool) l : (exists z l1 l2, l = l1 ++ z :: l2 /\ P z = true) \/ (forall z, In z l -> P z = false).
Proof.
  induction l as [| x l [(z & l1 & l2 & -> & H) | H]]; [now right | left; now exists z, (x :: l1), l2 |].
  destruct (P x) eqn:X; [left; now exists x, [], l |]. right. now intros z [<- | Z0]; [| apply H].
Qed.

(* Directions that go round, each less than half a turn on from the last: one step passes every direction. *)
Lemma step_around x l : (forall i j, In (i, j) (pairs (x :: l ++ [x])) -> 0 < c i j) ->
  exists i j, In (i, j) (pairs (x :: l ++ [x])) /\ 0 <= s i /\ s j <= 0.
Proof.
  intros H. destruct (Z_lt_ge_dec (s x) 0) as [N | N]; [| destruct (Z.eq_dec (s x) 0) as [Z0 | Z0]].
  - destruct (some_or_all (fun z => 0 <=? s z) l) as [(z & l1 & l2 & -> & Q) | Q].
    + apply Z.leb_le in Q. destruct (sign_change s l2 z x) as [i [j [I J]]]; [lia | lia |].
      exists i, j. split; [| exact J]. rewrite <- app_assoc. apply in_pairs_cons, in_pairs_after. exact I.
    + exfalso. apply (no_turn (fun i => - s i) c) with (x := x) (b := x) (l := l); try lia.
      * intros i j k. pose proof (exchange i j k). lia.
      * exact same.
      * intros z Z1. specialize (Q z Z1). apply Z.leb_gt in Q. lia.
      * exact H.
  - apply sign_change; lia.
  - destruct (some_or_all (fun z => s z <=? 0) l) as [(z & l1 & l2 & -> & Q) | Q].
    + apply Z.leb_le in Q. destruct (sign_change s l1 x z) as [i [j [I J]]]; [lia | lia |].
      exists i, j. split; [| exact J].
      replace (x :: (l1 ++ z :: l2) ++ [x]) with ((x :: l1 ++ [z]) ++ l2 ++ [x]).
      * now apply in_pairs_before.
      * simpl. now rewrite <- !app_assoc.
    + exfalso. apply (no_turn s c exchange same x l x); try lia.
      * intros z Z1. specialize (Q z Z1). apply Z.leb_gt in Q. lia.
      * exact H.
Qed.
End Around.

Lemma pair_members l i j : In (i, j) (pairs l) -> In i l /\ In j l.
Proof.
  induction l as [| x l IH]; [now simpl |]. destruct l as [| y l]; [now simpl |]. intros [E | H].
  - injection E as <- <-. split; [now left | right; now left].
  - destruct (IH H) as [I J]. split; now right.
Qed.

(* Every member of a list of two or more has a pair before it, or is the first; and one after it, or is the last. *)
Lemma pair_before l d i : In i l -> i = hd d l \/ exists k, In (k, i) (pairs l).
Proof.
  revert d. induction l as [| x l IH]; intros d; [now simpl |]. intros [-> | H]; [now left |]. right.
  destruct l as [| y l]; [destruct H |]. destruct (IH x H) as [E | [k K]].
  - simpl in E. subst i. exists x. now left.
  - exists k. now right.
Qed.

Lemma pair_after l d i : In i l -> i = last l d \/ exists k, In (i, k) (pairs l).
Proof.
  induction l as [| x l IH]; [now simpl |]. destruct l as [| y l]; [intros [-> | []]; now left |].
  intros [-> | H].
  - right. exists y. now left.
  - destruct (IH H) as [E | [k K]]; [left; exact E |]. right. exists k. now right.
Qed.

(* ---- maps hold only the entries put in ---- *)

Lemma map_triangles_in l k t : Map.find k (map_triangles l) = Some t -> In t l.
Proof.
  intros H. apply add_all_in in H. destruct H as [[I _] | H]; [exact I |].
  apply add_all_in in H. destruct H as [[I _] | H]; [exact I |]. now apply index_in in H.
Qed.

Lemma is_legal_sound edges i j : is_legal (map_edges edges) i j = true ->
  i <> j /\ exists e, In e edges /\ ((from e = i /\ to e = j) \/ (from e = j /\ to e = i)).
Proof.
  unfold is_legal. rewrite andb_true_iff, negb_true_iff, Z.eqb_neq. intros [N H]. split; [exact N |].
  destruct (Map.find _ _) as [e |] eqn:F; [| discriminate]. exists e. split; [now apply index_in in F |].
  rewrite orb_true_iff, !andb_true_iff, !Z.eqb_eq in H. exact H.
Qed.

(* ---- turns in integers ---- *)

Lemma turn_cycle a b c : turn a b c = turn b c a.
Proof. unfold turn. ring. Qed.

Lemma turn_same a b : turn a b b = 0%Z.
Proof. unfold turn. ring. Qed.

Lemma turn_exchange v a b c d : (turn v a c * turn v b d = turn v a b * turn v c d + turn v b c * turn v a d)%Z.
Proof. unfold turn. ring. Qed.

Lemma turn_weights a b c k :
  (turn a b c = turn b c k + turn c a k + turn a b k /\
   turn a b c * x0 k = turn b c k * x0 a + turn c a k * x0 b + turn a b k * x0 c /\
   turn a b c * y0 k = turn b c k * y0 a + turn c a k * y0 b + turn a b k * y0 c)%Z.
Proof. unfold turn. repeat split; ring. Qed.

Lemma weighted_above d u v w a b c k m : (d = u + v + w -> d * k = u * a + v * b + w * c -> 0 < d -> 0 <= u -> 0 <= v -> 0 <= w ->
  a <= m -> b <= m -> c <= m -> k <= m)%Z.
Proof.
  intros S E D U V W A B C. apply Z.nlt_ge. intros K.
  apply (Z.mul_lt_mono_pos_l d m k D) in K.
  pose proof (Z.mul_le_mono_nonneg_l _ _ u U A). pose proof (Z.mul_le_mono_nonneg_l _ _ v V B).
  pose proof (Z.mul_le_mono_nonneg_l _ _ w W C). assert (d * m = u * m + v * m + w * m)%Z by (rewrite S; ring). lia.
Qed.

Lemma weighted_below d u v w a b c k m : (d = u + v + w -> d * k = u * a + v * b + w * c -> 0 < d -> 0 <= u -> 0 <= v -> 0 <= w ->
  m <= a -> m <= b -> m <= c -> m <= k)%Z.
Proof.
  intros S E D U V W A B C. apply Z.nlt_ge. intros K.
  apply (Z.mul_lt_mono_pos_l d k m D) in K.
  pose proof (Z.mul_le_mono_nonneg_l _ _ u U A). pose proof (Z.mul_le_mono_nonneg_l _ _ v V B).
  pose proof (Z.mul_le_mono_nonneg_l _ _ w W C). assert (d * m = u * m + v * m + w * m)%Z by (rewrite S; ring). lia.
Qed.

Lemma max_three a b c : (a <= Z.max a (Z.max b c) /\ b <= Z.max a (Z.max b c) /\ c <= Z.max a (Z.max b c))%Z.
Proof. lia. Qed.

Lemma min_three a b c : (Z.min a (Z.min b c) <= a /\ Z.min a (Z.min b c) <= b /\ Z.min a (Z.min b c) <= c)%Z.
Proof. lia. Qed.

Lemma turn_corner a b k : turn_most a b (corner_of k) = turn a b k /\ turn_least a b (corner_of k) = turn a b k.
Proof.
  unfold turn_most, turn_least, turn, top, bottom, corner_of. simpl.
  split; destruct (0 <=? y0 a - y0 b)%Z; destruct (0 <=? x0 b - x0 a)%Z; ring.
Qed.

Lemma end_covers u p q r s : (p <= q)%Z -> (r <= s)%Z ->
  ((if 0 <=? u then u * r else u * q) <= (if 0 <=? u then u * s else u * p) /\
   (if 0 <=? u then u * p else u * s) <= (if 0 <=? u then u * q else u * r))%Z.
Proof. intros P R0. destruct (Z.leb_spec 0 u); nia. Qed.

Lemma heights_cover u v h b : covers h b -> (top u v b <= top u v h /\ bottom u v h <= bottom u v b)%Z.
Proof.
  intros (X0 & X1 & Y0 & Y1). destruct (end_covers u _ _ _ _ X0 X1). destruct (end_covers v _ _ _ _ Y0 Y1).
  unfold top, bottom. lia.
Qed.

Lemma turns_cover a b h k : covers h k -> (turn_most a b k <= turn_most a b h /\ turn_least a b h <= turn_least a b k)%Z.
Proof.
  intros C. destruct (heights_cover (y0 a - y0 b) (x0 b - x0 a) h k C). unfold turn_most, turn_least. cbv zeta. lia.
Qed.

Lemma off_triangle_covers a b c xa xb ya yb h k : covers h k ->
  off_triangle a b c xa xb ya yb h = true -> off_triangle a b c xa xb ya yb k = true.
Proof.
  intros C. destruct (turns_cover a b h k C) as [T1 _]. destruct (turns_cover b c h k C) as [T2 _].
  destruct (turns_cover c a h k C) as [T3 _]. destruct C as (X0 & X1 & Y0 & Y1).
  unfold off_triangle. rewrite !orb_true_iff, !Z.ltb_lt. lia.
Qed.

Lemma off_triangle_sound a b c k : (0 < turn a b c)%Z ->
  off_triangle a b c (Z.min (x0 a) (Z.min (x0 b) (x0 c))) (Z.max (x0 a) (Z.max (x0 b) (x0 c)))
    (Z.min (y0 a) (Z.min (y0 b) (y0 c))) (Z.max (y0 a) (Z.max (y0 b) (y0 c))) (corner_of k) = true ->
  (turn a b k < 0 \/ turn b c k < 0 \/ turn c a k < 0)%Z.
Proof.
  intros P H. destruct (Z_lt_ge_dec (turn a b k) 0) as [T1 | T1]; [now left |].
  destruct (Z_lt_ge_dec (turn b c k) 0) as [T2 | T2]; [right; now left |].
  destruct (Z_lt_ge_dec (turn c a k) 0) as [T3 | T3]; [right; now right |]. exfalso.
  destruct (turn_weights a b c k) as (S & X & Y).
  apply Z.ge_le in T1, T2, T3.
  destruct (max_three (x0 a) (x0 b) (x0 c)) as (A1 & A2 & A3). destruct (min_three (x0 a) (x0 b) (x0 c)) as (B1 & B2 & B3).
  destruct (max_three (y0 a) (y0 b) (y0 c)) as (C1 & C2 & C3). destruct (min_three (y0 a) (y0 b) (y0 c)) as (D1 & D2 & D3).
  pose proof (weighted_above _ _ _ _ _ _ _ _ _ S X P T2 T3 T1 A1 A2 A3) as U1.
  pose proof (weighted_below _ _ _ _ _ _ _ _ _ S X P T2 T3 T1 B1 B2 B3) as U2.
  pose proof (weighted_above _ _ _ _ _ _ _ _ _ S Y P T2 T3 T1 C1 C2 C3) as U3.
  pose proof (weighted_below _ _ _ _ _ _ _ _ _ S Y P T2 T3 T1 D1 D2 D3) as U4.
  unfold off_triangle in H. rewrite !(proj1 (turn_corner _ _ k)) in H. cbn [corner_of x0 x1 y0 y1] in H.
  rewrite !orb_true_iff, !Z.ltb_lt in H.
  destruct H as [[[[[[H | H] | H] | H] | H] | H] | H]; [exact (Zlt_not_le _ _ H U1) | exact (Zlt_not_le _ _ H U2) |
    exact (Zlt_not_le _ _ H U3) | exact (Zlt_not_le _ _ H U4) | exact (Zlt_not_le _ _ H T1) |
    exact (Zlt_not_le _ _ H T2) | exact (Zlt_not_le _ _ H T3)].
Qed.

(* ---- soundness ---- *)

Section Accepted.
Variables (D E : Z) (l : list site) (edges : list edge) (B : sites).
Variable accepted : check D E l edges = true.
Variable described : describes l B.
Variable bs : list box.
Variable scale : scaled_sites D E l = Some bs.

Notation N := (length l).

Lemma positive_unit : 0 < unit D E.
Proof.
  destruct (accepted_parts D E l edges accepted) as (bs' & _ & P & _). now apply unit_pos.
Qed.

Lemma names_rise : rising (-1) bs = true.
Proof.
  destruct (accepted_parts D E l edges accepted) as (bs' & H & _ & R0 & _). congruence.
Qed.

Lemma positive_scale : (0 < D)%Z.
Proof. now destruct (accepted_parts D E l edges accepted) as (bs' & _ & P & _). Qed.

(* The place of a name in the list. *)
Fixpoint position (bs : list box) (i : Z) : nat :=
  match bs with
  | [] => 0
  | b :: rest => if (box_name b =? i)%Z then 0 else S (position rest i)
  end.

Lemma position_found i b : find_box bs i = Some b -> nth_error bs (position bs i) = Some b /\ box_name b = i.
Proof.
  clear. unfold find_box. induction bs as [| a rest IH]; [discriminate |]. simpl.
  destruct (box_name a =? i)%Z eqn:Q; [| exact IH]. intros H. injection H as <-. split; [reflexivity | now apply Z.eqb_eq].
Qed.

Lemma position_named k b : nth_error bs k = Some b -> position bs (box_name b) = k.
Proof.
  intros H. assert (F : find_box bs (box_name b) = Some b) by (eapply find_box_nth; [apply names_rise | exact H | reflexivity]).
  destruct (position_found _ _ F) as [P _]. apply (rising_names (-1) bs _ _ b b names_rise P H eq_refl).
Qed.

Lemma found_named i b : find_box bs i = Some b -> named l (position bs i) i /\ (position bs i < N)%nat.
Proof.
  intros F. destruct (position_found i b F) as [P M].
  assert (K : (position bs i < N)%nat).
  { rewrite <- (scaled_sites_length D E l bs scale). apply nth_error_Some. congruence. }
  split; [| exact K].
  destruct (box_of D E l B described _ K bs scale positive_scale) as (s & b' & S & T & Q & _).
  exists s. split; [exact S | congruence].
Qed.

Lemma found_box i b : find_box bs i = Some b -> is_box (unit D E) b (B (position bs i)) /\ (x0 b <= x1 b)%Z /\ (y0 b <= y1 b)%Z.
Proof.
  intros F. destruct (position_found i b F) as [P M]. destruct (found_named i b F) as [_ K].
  destruct (box_of D E l B described _ K bs scale positive_scale) as (s & b' & S & T & Q & I & O).
  assert (b' = b) by congruence. subst b'. tauto.
Qed.

Lemma named_box k i : named l k i -> exists b, nth_error bs k = Some b /\ find_box bs i = Some b /\ box_name b = i /\ position bs i = k.
Proof.
  intros [s [S M]]. destruct (scaled_sites_nth D E l bs k s scale S) as [b [T _]].
  assert (K : (k < N)%nat) by (apply nth_error_Some; congruence).
  destruct (box_of D E l B described k K bs scale positive_scale) as (s' & b' & S' & T' & Q & _).
  assert (b' = b) by congruence. assert (s' = s) by congruence. subst b' s'. exists b.
  assert (Q' : box_name b = i) by congruence.
  split; [exact T |]. split; [eapply find_box_nth; [apply names_rise | exact T | exact Q'] |]. split; [exact Q' |].
  rewrite <- Q'. now apply position_named.
Qed.

Lemma sought_box i b : Map.find i (index box_name bs) = Some b -> find_box bs i = Some b.
Proof. exact (found_box_is (-1) bs i b names_rise). Qed.

(* What the tree answers holds of all boxes. *)
Lemma everywhere passes test : (forall h b, covers h b -> ordered b -> passes h = true -> test b = true) ->
  all_in passes test (build deepest bs) = true -> forall k, In k bs -> test k = true.
Proof.
  intros M H k I. refine (all_in_each passes test k M _ deepest bs H I). apply In_nth_error in I. destruct I as [n I].
  assert (K : (n < N)%nat) by (rewrite <- (scaled_sites_length D E l bs scale); apply nth_error_Some; congruence).
  destruct (box_of D E l B described n K bs scale positive_scale) as (s & b & _ & T & _ & _ & O).
  assert (b = k) by congruence. now subst b.
Qed.

(* The choice of the lower left corners. *)
Definition places (k : nat) : point := (xlo (B k), ylo (B k)).

Lemma places_choice : choice N B places.
Proof.
  intros k _. unfold places, inside. simpl. pose proof (x_ordered (B k)). pose proof (y_ordered (B k)). lra.
Qed.

Lemma turn_value i j k a b c : find_box bs i = Some a -> find_box bs j = Some b -> find_box bs k = Some c ->
  IZR (turn a b c) =
  unit D E * unit D E * orient (places (position bs i)) (places (position bs j)) (places (position bs k)).
Proof.
  intros I J K. destruct (found_box i a I) as [(X & _ & Y & _) _]. destruct (found_box j b J) as [(X' & _ & Y' & _) _].
  destruct (found_box k c K) as [(X'' & _ & Y'' & _) _].
  unfold turn, orient, places. simpl. rewrite minus_IZR, !mult_IZR, !minus_IZR, X, Y, X', Y', X'', Y''. ring.
Qed.

Lemma turn_sign i j k a b c : find_box bs i = Some a -> find_box bs j = Some b -> find_box bs k = Some c ->
  let o := orient (places (position bs i)) (places (position bs j)) (places (position bs k)) in
  ((0 < turn a b c)%Z -> 0 < o) /\ ((0 <= turn a b c)%Z -> 0 <= o) /\ ((turn a b c <= 0)%Z -> o <= 0).
Proof.
  intros I J K o. pose proof (turn_value i j k a b c I J K) as H. fold o in H. pose proof positive_unit as U.
  assert (V : 0 < unit D E * unit D E) by now apply Rmult_lt_0_compat.
  repeat split; intros T; [apply IZR_lt in T | apply IZR_le in T | apply IZR_le in T]; rewrite H in T; nra.
Qed.

Lemma legal_pair i j : is_legal (map_edges edges) i j = true ->
  i <> j /\ legal N B (position bs i) (position bs j) /\ position bs i <> position bs j.
Proof.
  intros H. destruct (is_legal_sound edges i j H) as [M [e [I Q]]].
  destruct (accepted_names D E l edges B accepted described e I) as [[a A] [b C]].
  destruct (named_box a _ A) as (ba & _ & _ & Na & Pa). destruct (named_box b _ C) as (bb & _ & _ & Nb & Pb).
  pose proof (accepted_witness D E l edges B accepted described e a b I A C) as W. split; [exact M |].
  assert (L : legal N B a b) by (eexists; exact W).
  assert (L' : legal N B b a) by (eexists; apply witness_sym; exact W).
  assert (X : a <> b).
  { intros ->. destruct A as [s [S F]], C as [s' [S' F']]. assert (s' = s) by congruence. subst s'.
    destruct Q as [[Q1 Q2] | [Q1 Q2]]; congruence. }
  destruct Q as [[<- <-] | [<- <-]]; rewrite Pa, Pb; split; auto.
Qed.

(* ---- triangles ---- *)

(* The facts known of a face of a fan. *)
Definition good_face (a i j : Z) : Prop :=
  is_legal (map_edges edges) a i = true /\ is_legal (map_edges edges) a j = true /\
  is_legal (map_edges edges) i j = true /\
  exists ba bi bj, find_box bs a = Some ba /\ find_box bs i = Some bi /\ find_box bs j = Some bj /\
    (0 < turn ba bi bj)%Z /\
    forall k, In k bs -> box_name k <> a -> box_name k <> i -> box_name k <> j ->
      (turn ba bi k < 0 \/ turn bi bj k < 0 \/ turn bj ba k < 0)%Z.

Lemma is_legal_sym m i j : is_legal m i j = true -> is_legal m j i = true.
Proof.
  unfold is_legal. rewrite (Z.min_comm j i), (Z.max_comm j i), (Z.eqb_sym j i).
  destruct (Map.find _ _) as [e |]; [| easy]. now rewrite orb_comm.
Qed.

Lemma good_face_turn a i j : good_face a i j -> good_face i j a.
Proof.
  intros (L1 & L2 & L3 & ba & bi & bj & A & I & J & T & H).
  split; [exact L3 |]. split; [now apply is_legal_sym |]. split; [now apply is_legal_sym |].
  exists bi, bj, ba. repeat (split; [assumption |]). split; [now rewrite <- turn_cycle |].
  intros k K Ni Nj Na. destruct (H k K Na Ni Nj) as [X | [X | X]]; tauto.
Qed.

Notation by_name := (index box_name bs).
Notation check_triangles := (check_triangle by_name (build deepest bs) (map_edges edges)).

Lemma check_triangle_sound t : check_triangles t = true -> good_face (ta t) (tb t) (tc t).
Proof.
  unfold check_triangle. rewrite !andb_true_iff. intros [[[L1 L2] L3] H].
  destruct (Map.find (ta t) _) as [a |] eqn:A; [| discriminate].
  destruct (Map.find (tb t) _) as [b |] eqn:F; [| discriminate].
  destruct (Map.find (tc t) _) as [c |] eqn:C; [| discriminate]. apply sought_box in A, F, C.
  apply andb_true_iff in H. destruct H as [T H]. apply Z.ltb_lt in T. unfold empty_triangle in H. cbv zeta in H.
  pose proof (fun M => everywhere _ _ M H) as G. clear H.
  split; [exact L1 |]. split; [now apply is_legal_sym |]. split; [exact L2 |]. exists a, b, c.
  repeat (split; [assumption |]). intros k K Na Nb Nc.
  destruct (position_found _ _ A) as [_ Qa]. destruct (position_found _ _ F) as [_ Qb].
  destruct (position_found _ _ C) as [_ Qc].
  assert (H := G (fun h b0 Ch Ob Off => proj2 (orb_true_iff _ _)
    (or_intror (off_triangle_covers a b c _ _ _ _ h (corner_of b0) (covers_corner h b0 Ch Ob) Off))) k K).
  rewrite !orb_true_iff, !Z.eqb_eq in H. destruct H as [[[H | H] | H] | H]; try congruence.
  now apply off_triangle_sound.
Qed.

Lemma has_triangle_sound triangles a i j :
  has_triangle (map_triangles (kept check_triangles triangles)) a i j = true -> good_face a i j.
Proof.
  unfold has_triangle. destruct (Map.find _ _) as [t |] eqn:F; [| discriminate].
  apply map_triangles_in, kept_in in F. destruct F as [_ F]. apply check_triangle_sound in F.
  rewrite !orb_true_iff, !andb_true_iff, !Z.eqb_eq. intros [[[[<- <-] <-] | [[<- <-] <-]] | [[<- <-] <-]].
  - exact F.
  - now apply good_face_turn.
  - now apply good_face_turn, good_face_turn.
Qed.

(* ---- corners ---- *)

Lemma end_value S u z0 z1 lo hi t : 0 < S -> IZR z0 = lo * S -> IZR z1 = hi * S -> lo <= t <= hi ->
  IZR (if (0 <=? u)%Z then u * z0 else u * z1) <= S * (IZR u * t) <= IZR (if (0 <=? u)%Z then u * z1 else u * z0).
Proof.
  intros P L H T. destruct (Z.leb_spec 0 u) as [U | U]; rewrite !mult_IZR, L, H;
    [apply IZR_le in U | apply IZR_lt in U]; split.
  - assert (IZR u * lo <= IZR u * t) by nra. nra.
  - assert (IZR u * t <= IZR u * hi) by nra. nra.
  - assert (IZR u * hi <= IZR u * t) by nra. nra.
  - assert (IZR u * t <= IZR u * lo) by nra. nra.
Qed.

Lemma heights S u v b R0 z : 0 < S -> is_box S b R0 -> inside z R0 ->
  IZR (bottom u v b) <= S * dot (IZR u, IZR v) z <= IZR (top u v b).
Proof.
  intros P (X0 & X1 & Y0 & Y1) [X Y]. unfold bottom, top, dot. cbn [fst snd]. rewrite !plus_IZR.
  pose proof (end_value S u _ _ _ _ _ P X0 X1 X). pose proof (end_value S v _ _ _ _ _ P Y0 Y1 Y). lra.
Qed.

Lemma corner_sound corners v : is_corner (index vertex (kept (check_corner by_name (build deepest bs)) corners)) v = true -> sure_hull N B (position bs v).
Proof.
  unfold is_corner. destruct (Map.find v _) as [c |] eqn:I; [| discriminate]. intros _.
  apply index_in in I. destruct I as [I <-]. apply kept_in in I. destruct I as [_ H]. unfold check_corner in H.
  destruct (Map.find (vertex c) _) as [b |] eqn:F; [| discriminate]. apply sought_box in F. cbv zeta in H.
  assert (M : forall h k, covers h k -> ordered k -> (top (ux c) (uy c) h <? bottom (ux c) (uy c) b)%Z = true ->
    ((top (ux c) (uy c) k <? bottom (ux c) (uy c) b)%Z || (box_name k =? vertex c)%Z)%bool = true).
  { intros h k Ch _ G. apply orb_true_iff. left. apply Z.ltb_lt in G. apply Z.ltb_lt.
    destruct (heights_cover (ux c) (uy c) h k Ch). lia. }
  pose proof (everywhere _ _ M H) as H'. clear H M. rename H' into H.
  exists (IZR (ux c), IZR (uy c)). intros k x y K Nk X Y.
  destruct (box_of D E l B described k K bs scale positive_scale) as (s & bk & S & T & M & Ik & _).
  destruct (found_box _ _ F) as [Ib _]. pose proof positive_unit as U.
  specialize (H bk (nth_error_In _ _ T)). apply orb_true_iff in H. destruct H as [H | H].
  - apply Z.ltb_lt, IZR_lt in H. pose proof (heights _ (ux c) (uy c) _ _ _ U Ik Y). pose proof (heights _ (ux c) (uy c) _ _ _ U Ib X).
    apply (Rmult_lt_reg_l (unit D E)); [exact U | lra].
  - exfalso. apply Nk. apply Z.eqb_eq in H. rewrite <- H. symmetry. now apply position_named.
Qed.

(* ---- fans ---- *)

Variables (triangles : list triangle) (corners : list corner) (fans : list fan) (f : fan).
Variable surround : In f (surrounded D E l edges triangles corners fans).

Notation good := (map_triangles (kept check_triangles triangles)).
Notation sure := (index vertex (kept (check_corner by_name (build deepest bs)) corners)).

Lemma fan_checked : check_fan by_name (build deepest bs) good sure f = true.
Proof. unfold surrounded in surround. rewrite scale in surround. exact (proj2 (kept_in _ _ _ surround)). Qed.

Lemma fan_faces i j : In (i, j) (pairs (ring f)) -> good_face (centre f) i j.
Proof.
  intros H. pose proof fan_checked as C. unfold check_fan in C. apply andb_true_iff in C. destruct C as [C _].
  rewrite forallb_forall in C. specialize (C (i, j) H). simpl in C. now apply has_triangle_sound in C.
Qed.

Lemma ring_spokes i : In i (ring f) -> In i (spokes f).
Proof.
  unfold ring. destruct (whole f); [| easy]. rewrite in_app_iff. intros [H | H]; [exact H |].
  destruct (spokes f) as [| x r]; [destruct H |]. simpl in H. destruct H as [<- | []]. now left.
Qed.

Section Other.
Variables (b : nat) (i_b : Z) (bb ba : box).
Variable Pb : find_box bs i_b = Some bb.
Variable Nb : position bs i_b = b.
Variable Pa : find_box bs (centre f) = Some ba.
Variable other : i_b <> centre f.
Variable not_spoke : ~ In i_b (spokes f).

Notation a := (position bs (centre f)).
Definition faces : list (nat * nat) := map (fun s => (position bs (fst s), position bs (snd s))) (pairs (ring f)).

Lemma in_faces i j : In (i, j) faces -> exists u v, In (u, v) (pairs (ring f)) /\ position bs u = i /\ position bs v = j.
Proof.
  intros H. apply in_map_iff in H. destruct H as [[u v] [Q I]]. injection Q as <- <-. now exists u, v.
Qed.

Lemma position_inj u v bu bv : find_box bs u = Some bu -> find_box bs v = Some bv -> u <> v -> position bs u <> position bs v.
Proof.
  intros U V M Q. destruct (position_found _ _ U) as [X X']. destruct (position_found _ _ V) as [Y Y']. rewrite Q in X.
  assert (bu = bv) by congruence. subst bv. congruence.
Qed.

Lemma faces_legal : legal_faces N B a b faces.
Proof.
  intros i j H. destruct (in_faces i j H) as (u & v & I & <- & <-).
  destruct (fan_faces u v I) as (L1 & L2 & L3 & x & y & z & X & Y & Z0 & _).
  destruct (pair_members _ _ _ I) as [Iu Iv]. apply ring_spokes in Iu, Iv.
  destruct (legal_pair _ _ L1) as (M1 & G1 & Q1). destruct (legal_pair _ _ L2) as (M2 & G2 & Q2).
  destruct (legal_pair _ _ L3) as (M3 & G3 & Q3).
  destruct (found_named _ _ Y) as [_ Ku]. destruct (found_named _ _ Z0) as [_ Kv].
  repeat (split; [try assumption |]); try assumption; try now apply not_eq_sym.
  - rewrite <- Nb. now apply (position_inj _ _ bb ba).
  - rewrite <- Nb. apply (position_inj _ _ bb y); [assumption | assumption |]. congruence.
  - rewrite <- Nb. apply (position_inj _ _ bb z); [assumption | assumption |]. congruence.
Qed.

Lemma in_map_faces u v : In (u, v) (pairs (ring f)) -> In (position bs u, position bs v) faces.
Proof. intros H. apply in_map_iff. now exists (u, v). Qed.

(* The ring of a whole fan begins and ends with one spoke. *)
Lemma whole_ring : whole f = true -> exists x m, ring f = x :: m ++ [x].
Proof.
  intros W. pose proof fan_checked as C. unfold check_fan in C. apply andb_true_iff in C. destruct C as [_ C].
  unfold ring in *. rewrite W in *. destruct (spokes f) as [| x m]; [discriminate |]. now exists x, m.
Qed.

Lemma open_ring : whole f = false -> exists x m y, ring f = x :: m ++ [y] /\ is_corner sure x = true /\
  is_corner sure y = true /\ within by_name (build deepest bs) f x y = true.
Proof.
  intros W. pose proof fan_checked as C. unfold check_fan in C. apply andb_true_iff in C. destruct C as [_ C].
  rewrite W in C. destruct (ring f) as [| x r]; [discriminate |]. destruct r as [| z r]; [discriminate |].
  cbv zeta in C. rewrite !andb_true_iff in C. destruct C as [[C1 C2] C3].
  exists x, (removelast (z :: r)), (last (z :: r) x). split; [| split; [| split]].
  - f_equal. apply app_removelast_last. discriminate.
  - exact C1.
  - exact C2.
  - exact C3.
Qed.

Lemma last_snoc {A} (m : list A) y d : last (m ++ [y]) d = y.
Proof. induction m as [| x m IH]; [reflexivity |]. simpl. destruct (m ++ [y]) eqn:Q; [now destruct m | exact IH]. Qed.

Lemma faces_closed : no_gap N B faces.
Proof.
  intros i j H. destruct (in_faces i j H) as (u & v & I & <- & <-). destruct (pair_members _ _ _ I) as [Iu Iv].
  assert (Before : forall w, In w (ring f) -> sure_hull N B (position bs w) \/ exists k, In (k, position bs w) faces).
  { intros w Iw. destruct (pair_before _ w w Iw) as [Q | [k K]].
    - destruct (whole f) eqn:W.
      + destruct (whole_ring W) as (x & m & R0). rewrite R0 in Q. simpl in Q. subst x. right.
        destruct (pair_before (m ++ [w]) w w) as [Q | [k K]]; [apply in_app_iff; right; now left | |].
        * destruct m as [| y m].
          -- exists (position bs w). apply in_map_faces. rewrite R0. now left.
          -- simpl in Q. subst y. exists (position bs w). apply in_map_faces. rewrite R0. now left.
        * exists (position bs k). apply in_map_faces. rewrite R0. now apply in_pairs_cons.
      + destruct (open_ring W) as (x & m & y & R0 & C1 & _). rewrite R0 in Q. simpl in Q. subst x. left.
        now apply corner_sound in C1.
    - right. exists (position bs k). now apply in_map_faces. }
  assert (After : forall w, In w (ring f) -> sure_hull N B (position bs w) \/ exists k, In (position bs w, k) faces).
  { intros w Iw. destruct (pair_after _ w w Iw) as [Q | [k K]].
    - destruct (whole f) eqn:W.
      + destruct (whole_ring W) as (x & m & R0). rewrite R0 in Q.
        change (x :: m ++ [x]) with ((x :: m) ++ [x]) in Q. rewrite last_snoc in Q. subst x. right.
        destruct (m ++ [w]) as [| y r] eqn:M; [now destruct m |].
        exists (position bs y). apply in_map_faces. rewrite R0. now left.
      + destruct (open_ring W) as (x & m & y & R0 & _ & C2 & _). rewrite R0 in Q.
        change (x :: m ++ [y]) with ((x :: m) ++ [y]) in Q. rewrite last_snoc in Q. subst y. left.
        now apply corner_sound in C2.
    - right. exists (position bs k). now apply in_map_faces. }
  split; [now apply Before | now apply After].
Qed.

Lemma faces_left : all_left a faces places.
Proof.
  intros i j H. destruct (in_faces i j H) as (u & v & I & <- & <-).
  destruct (fan_faces u v I) as (_ & _ & _ & x & y & z & X & Y & Z0 & T & _).
  destruct (turn_sign _ _ _ _ _ _ X Y Z0) as [P _]. now apply P.
Qed.

(* The box of a name, and anything for other names. *)
Definition box_at (i : Z) : box := match find_box bs i with Some b => b | None => ba end.

Lemma step_found : exists u v, In (u, v) (pairs (ring f)) /\ (0 <= turn ba (box_at u) bb)%Z /\ (turn ba (box_at v) bb <= 0)%Z.
Proof.
  destruct (whole f) eqn:W.
  - destruct (whole_ring W) as (x & m & R0). rewrite R0.
    apply (step_around (fun i => turn ba (box_at i) bb) (fun i j => turn ba (box_at i) (box_at j))).
    + intros i j k. apply turn_exchange.
    + intros i. apply turn_same.
    + intros i j I. rewrite <- R0 in I. destruct (fan_faces i j I) as (_ & _ & _ & p & q & r & X & Y & Z0 & T & _).
      unfold box_at. rewrite Y, Z0. congruence.
  - destruct (open_ring W) as (x & m & y & R0 & _ & _ & C). rewrite R0.
    unfold within in C. destruct (Map.find (centre f) _) as [bc |] eqn:Fc; [| discriminate].
    destruct (Map.find x _) as [bx |] eqn:X; [| discriminate]. destruct (Map.find y _) as [by_ |] eqn:Y; [| discriminate].
    apply sought_box in Fc, X, Y. assert (bc = ba) by congruence. subst bc.
    assert (M : forall h k, covers h k -> ordered k ->
      ((0 <=? turn_least ba bx h)%Z && (turn_most ba by_ h <=? 0)%Z)%bool = true ->
      ((0 <=? turn ba bx k)%Z && (turn ba by_ k <=? 0)%Z)%bool = true).
    { intros h k Ch Ok. rewrite !andb_true_iff, !Z.leb_le. pose proof (covers_corner h k Ch Ok) as Cc.
      destruct (turns_cover ba bx h _ Cc) as [_ G1]. destruct (turns_cover ba by_ h _ Cc) as [G2 _].
      rewrite (proj2 (turn_corner ba bx k)) in G1. rewrite (proj1 (turn_corner ba by_ k)) in G2. lia. }
    destruct (position_found _ _ Pb) as [Q _]. pose proof (everywhere _ _ M C bb (nth_error_In _ _ Q)) as G.
    apply andb_true_iff in G. destruct G as [C1 C2]. apply Z.leb_le in C1, C2.
    apply (sign_change (fun i => turn ba (box_at i) bb)); unfold box_at; [now rewrite X | now rewrite Y].
Qed.

Lemma leaves_a_face : leaves_some a b faces places.
Proof.
  destruct step_found as (u & v & I & S1 & S2). exists (position bs u), (position bs v).
  split; [now apply in_map_faces |].
  destruct (fan_faces u v I) as (_ & _ & _ & x & y & z & X & Y & Z0 & T & Em).
  assert (x = ba) by congruence. subst x. unfold box_at in S1, S2. rewrite Y in S1. rewrite Z0 in S2.
  destruct (pair_members _ _ _ I) as [Iu Iv]. apply ring_spokes in Iu, Iv.
  destruct (position_found _ _ Pb) as [Q Qn]. rewrite <- Nb.
  assert (G : (turn y z bb < 0)%Z).
  { destruct (Em bb (nth_error_In _ _ Q)) as [G | [G | G]]; try congruence; try lia.
    exfalso. assert (M : (turn z ba bb = - turn ba z bb)%Z) by (unfold turn; ring). lia. }
  assert (S3 : (0 <= turn ba bb z)%Z).
  { assert (M : (turn ba bb z = - turn ba z bb)%Z) by (unfold turn; ring). lia. }
  split; [| split].
  - destruct (turn_sign _ _ _ _ _ _ Pa Y Pb) as (_ & H & _). now apply H.
  - destruct (turn_sign _ _ _ _ _ _ Pa Pb Z0) as (_ & H & _). now apply H.
  - destruct (turn_sign _ _ _ _ _ _ Y Z0 Pb) as (_ & _ & H). apply H. lia.
Qed.
End Other.
End Accepted.

(* A surrounded site has no possible pair but with its spokes. *)
Theorem surrounded_illegal D E l edges B triangles corners fans f a b i :
  check D E l edges = true -> describes l B -> In f (surrounded D E l edges triangles corners fans) ->
  named l a (centre f) -> named l b i -> a <> b -> ~ In i (spokes f) -> ~ possible (length l) B a b.
Proof.
  intros C F I A G M S. destruct (accepted_parts D E l edges C) as (bs & H & _).
  destruct (named_box D E l edges B C F bs H a _ A) as (ba & _ & Pa & _ & Na).
  destruct (named_box D E l edges B C F bs H b _ G) as (bb & _ & Pb & _ & Nb).
  destruct (found_named D E l edges B C F bs H _ _ Pa) as [_ Ka]. destruct (found_named D E l edges B C F bs H _ _ Pb) as [_ Kb].
  assert (O : i <> centre f) by (intros ->; congruence).
  subst a. subst b.
  refine (rest_is_illegal (length l) B _ _ (faces bs f) Ka Kb _ _ (places B) _ _ _).
  - eapply faces_legal; try eassumption; reflexivity.
  - eapply faces_closed; eassumption.
  - apply places_choice.
  - eapply faces_left; eassumption.
  - eapply leaves_a_face; try eassumption; reflexivity.
Qed.

(* A spoke of a surrounded site is a legal pair with it. *)
Theorem surrounded_spokes D E l edges B triangles corners fans f i :
  check D E l edges = true -> describes l B -> In f (surrounded D E l edges triangles corners fans) ->
  In i (spokes f) -> exists e, In e edges /\
    ((from e = centre f /\ to e = i) \/ (from e = i /\ to e = centre f)).
Proof.
  intros C F I S. destruct (accepted_parts D E l edges C) as (bs & H & _).
  assert (R0 : In i (ring f)) by (unfold ring; destruct (whole f); [apply in_app_iff; now left | exact S]).
  assert (K : exists u v, In (u, v) (pairs (ring f)) /\ (i = u \/ i = v)).
  { destruct (pair_before _ i i R0) as [Q | [k Q]]; [| now exists k, i; split; [| right]].
    destruct (pair_after _ i i R0) as [Q' | [k Q']]; [| now exists i, k; split; [| left]].
    pose proof (fan_checked D E l edges bs H triangles corners fans f I) as G. unfold check_fan in G.
    apply andb_true_iff in G. destruct G as [_ G]. destruct (ring f) as [| x [| y r]]; [discriminate | discriminate |].
    simpl in Q. subst x. exists i, y. split; [now left | now left]. }
  destruct K as (u & v & P & Q).
  destruct (fan_faces D E l edges B C F bs H triangles corners fans f I u v P) as (L1 & L2 & _).
  destruct Q as [-> | ->]; [apply is_legal_sound in L1; now destruct L1 | apply is_legal_sound in L2; now destruct L2].
Qed.

Lemma possible_sym N B i j : possible N B i j -> possible N B j i.
Proof.
  intros [[c H] | [u [U H]]]; [left; exists c | right; exists u].
  - intros k K J I. destruct (H k K I J). now split.
  - split; [exact U |]. intros a k A S K. apply (H a k A); [unfold pair in *; tauto | exact K].
Qed.

(* A site that is surrounded has its possible pairs listed. *)
Lemma surrounded_listed D E l edges B triangles corners fans f a b j :
  check D E l edges = true -> describes l B -> In f (surrounded D E l edges triangles corners fans) ->
  named l a (centre f) -> named l b j -> a <> b -> possible (length l) B a b ->
  exists e, In e edges /\ ((from e = centre f /\ to e = j) \/ (from e = j /\ to e = centre f)).
Proof.
  intros C F I A G M P. destruct (in_dec Z.eq_dec j (spokes f)) as [X | X].
  - exact (surrounded_spokes D E l edges B triangles corners fans f j C F I X).
  - destruct (surrounded_illegal D E l edges B triangles corners fans f a b j C F I A G M X P).
Qed.

(* The whole certificate of a decided triangulation: all possible pairs are listed, and all listed pairs are legal. *)
Theorem decided_exact D E l edges B triangles corners fans a b i j :
  check D E l edges = true -> describes l B ->
  all_surrounded l edges (surrounded D E l edges triangles corners fans) = true ->
  named l a i -> named l b j -> a <> b ->
  (possible (length l) B a b <->
   exists e, In e edges /\ ((from e = i /\ to e = j) \/ (from e = j /\ to e = i))).
Proof.
  intros C F All A G M. set (found := surrounded D E l edges triangles corners fans) in *. split.
  - intros P. unfold all_surrounded in All. cbv zeta in All. set (rest := kept _ l) in All.
    assert (Sort : forall k s, nth_error l k = Some s -> (exists f, In f found /\ centre f = name s) \/ In s rest).
    { intros k s S. destruct (Map.find (name s) (index centre found)) as [f |] eqn:Q.
      - left. apply index_in in Q. now exists f.
      - right. apply in_kept; [exact (nth_error_In _ _ S) | now rewrite Q]. }
    pose proof A as [sa [Sa Na]]. pose proof G as [sb [Sb Nb]].
    destruct (Sort a sa Sa) as [[f [I K]] | Ra].
    { rewrite Na in K. clear Sa Na. subst i. exact (surrounded_listed D E l edges B _ _ _ f a b j C F I A G M P). }
    destruct (Sort b sb Sb) as [[f [I K]] | Rb].
    { rewrite Nb in K. clear Sb Nb. subst j. apply possible_sym in P.
      destruct (surrounded_listed D E l edges B _ _ _ f b a i C F I G A (not_eq_sym M) P) as [e [Y Q]].
      exists e. tauto. }
    rewrite forallb_forall in All. specialize (All sa Ra). rewrite forallb_forall in All. specialize (All sb Rb).
    rewrite Na, Nb in All. apply orb_true_iff in All. destruct All as [Q | Q]; [| now apply is_legal_sound in Q].
    apply Z.eqb_eq in Q. subst j. exfalso. destruct (accepted_parts D E l edges C) as (bs & H & _).
    destruct (named_box D E l edges B C F bs H a i A) as (_ & _ & _ & _ & Pa).
    destruct (named_box D E l edges B C F bs H b i G) as (_ & _ & _ & _ & Pb). congruence.
  - intros [e [I Q]]. assert (La : (a < length l)%nat) by (destruct A as [s [A _]]; apply nth_error_Some; congruence).
    assert (Lb : (b < length l)%nat) by (destruct G as [s [G _]]; apply nth_error_Some; congruence).
    assert (W : legal (length l) B a b).
    { destruct Q as [[<- <-] | [<- <-]].
      - eexists. now apply (accepted_witness D E l edges B C F e a b).
      - eexists. apply witness_sym. now apply (accepted_witness D E l edges B C F e b a). }
    destruct W as [c W]. left. exists c. intros k K Da Db. destruct (W k K Da Db).
    pose proof (ds_le_dl c (B a)). pose proof (ds_le_dl c (B b)). pose proof (ds_le_dl c (B k)). lra.
Qed.
